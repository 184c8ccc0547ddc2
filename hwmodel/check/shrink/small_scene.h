// Where the scenes lie that a search for a small one tries.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "kernel/automaton/state/volume.h"
#include "kernel/run/io/unfinished.h"
#include "kernel/scene/scene.h"

namespace voxmelt::hwmodel::check {

// A folder of this process that goes away with it.
class Workplace {
 public:
  explicit Workplace(const std::filesystem::path& beside);
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  ~Workplace();

  // A case is written and loaded as its user will do it. So what is left in the end can be seen again.
  // `text`: the scene's, with its fields in "."; null: it is no scene of its own.
  std::unique_ptr<scene::Scene> load(const state::Volume& volume, const std::string& text) const;

 private:
  void remove();

  std::filesystem::path folder_;
  io::Unfinished unfinished_;
};

// Cells that hold something.
int count_matter(const state::Volume& volume);

}  // namespace voxmelt::hwmodel::check
