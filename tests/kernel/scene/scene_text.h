// Loads scenes from text, in a folder of their own under the tests' temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "kernel/scene/scene.h"

namespace voxmelt::scene {

// Owns the folder scene_text/<suite>.<test>, emptied for each test.
class SceneFolder {
 public:
  SceneFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / "scene_text" /
              (std::string(test->test_suite_name()) + "." + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~SceneFolder() { std::filesystem::remove_all(folder_); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  Scene load_text(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return load(write("scene.toml", text), overrides);
  }

  // Returns the message that loading ends with, without its folder, or nothing if the scene is accepted.
  std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    try {
      load_text(text, overrides);
    } catch (const InputError& error) {
      return without_folder(error.what());
    }
    return {};
  }

  std::string without_folder(std::string message) const {
    const std::string prefix = folder_.string() + "/";
    for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
    return message;
  }

 private:
  std::filesystem::path folder_;
};

inline std::filesystem::path committed_scenes() { return VOXMELT_SCENES_FOLDER; }

// Returns the mass of the solid in cells.
inline double solid_mass(const state::Volume& volume) {
  std::int64_t sum = 0;
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y < volume.grid.y; ++y)
      for (int x = 0; x < volume.grid.x; ++x)
        if (volume.solid.test(x, y, z)) sum += volume.amount[volume.at(x, y, z)];
  return static_cast<double>(sum) / 4096;
}

}  // namespace voxmelt::scene
