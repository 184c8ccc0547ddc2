// The frames of a contact sheet are kept at half their size.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "render/image/image.h"

namespace voxmelt::render {

// Returns which of `count` frames a sheet shows. At most twelve are chosen evenly, with the first and the
// last.
std::vector<std::size_t> shown_frames(std::size_t count);

class SheetFrames {
 public:
  // Belongs to a run that plans this many frames. An interrupted one makes fewer.
  explicit SheetFrames(std::size_t planned);

  // Keeps the frame if the plan shows it. Any thread may call it.
  void offer(std::size_t frame, const Image& image);

  // Makes the sheet once all frames were offered, one per label. `read` gives a frame that the plan did not
  // show.
  Image sheet(const std::vector<std::string>& labels, const std::function<Image(std::size_t)>& read) const;

 private:
  std::mutex mutex_;
  std::map<std::size_t, Image> halves_;  // empty pictures until their frame comes
};

}  // namespace voxmelt::render
