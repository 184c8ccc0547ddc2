// A film of a run is made beside it: the run is done again from its beginning, with all changes, and every
// frame is the best picture. The page goes on meanwhile.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "library/journal/journal.h"
#include "voxmelt/voxmelt.h"

namespace voxmelt::view {

class Film {
 public:
  // Says how far it is, and at last what came of it. Its own thread calls this.
  struct Progress {
    std::uint32_t frames = 0, planned = 0;
    bool over = false;
    std::string film{};   // bytes of the film, once it is over
    std::string ending;   // of its file's name: .mp4 or .webp
    std::string problem;  // why there is none; both are empty if it was stopped
  };
  using Tell = std::function<void(Progress)>;

  struct Plan {
    std::function<Simulation()> open;  // gives the run at its beginning
    std::vector<journal::Line> changes;
    std::uint32_t first = 0, last = 0;  // steps done at the first frame and at the last one
    std::uint32_t every = 1;            // steps between frames
    Picture picture;
  };

  // Throws InputError where no film can be made.
  Film(Plan plan, Tell tell);

  void stop() { thread_.request_stop(); }  // it ends soon

 private:
  std::jthread thread_;
};

}  // namespace voxmelt::view
