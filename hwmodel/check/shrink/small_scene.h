// The search for a small scene writes its scenes to a folder, and loads them from there.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "kernel/automaton/state/volume.h"
#include "kernel/run/io/unfinished.h"
#include "kernel/scene/scene.h"

namespace voxmelt::hwmodel::check {

// A folder of this process that is removed with the object.
class Workplace {
 public:
  explicit Workplace(const std::filesystem::path& beside);
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  ~Workplace();

  // Writes a case and loads it as its user will, so that the scene found at the end can be loaded again.
  // `text` is the scene file, with its fields in ".". Returns null if it is no valid scene.
  std::unique_ptr<scene::Scene> load(const state::Volume& volume, const std::string& text) const;

 private:
  void remove();

  std::filesystem::path folder_;
  io::Unfinished unfinished_;
};

// Counts the cells that hold something.
int count_matter(const state::Volume& volume);

}  // namespace voxmelt::hwmodel::check
