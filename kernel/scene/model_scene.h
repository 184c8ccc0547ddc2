// A model without a scene gets one: it is fitted to a grid, on a floor, below a lamp. Heights become ground,
// with lava on their highest place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace voxmelt::scene {

// Tells if a file holds a model, by the ending of its name, so that it is no scene.
bool is_model_file(const std::filesystem::path& file);

struct ModelScene {
  std::string text;                  // of a scene file, with comments, for whoever wants to change it
  std::vector<std::string> assumed;  // the same in three lines
};

// Reads the model for its size. It throws InputError.
ModelScene scene_of_model(const std::filesystem::path& model);

}  // namespace voxmelt::scene
