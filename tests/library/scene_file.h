// The tests of the public interface have a small scene in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <voxmelt/voxmelt.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace voxmelt {

// The scene has a warm block over a floor, a lamp beside it, and visibility every 4th step.
inline const char* const kSmallScene = R"(title = "small"
[grid]
size = [70, 12, 20]
[[solid]]
shape = "box"
size = [6, 5, 6]
at = [10, 5.5, 10]
temperature = 0.45
[[inert]]
shape = "floor"
thickness = 2
[heat]
gamma = 0.15
visibility_every = 4
[[heat_source]]
at = [20, 11, 10]
power = 4
)";

class SceneFile : public testing::Test {
 protected:
  SceneFile() {
    // Test programs run one test per process: the name of the test makes the folder its own.
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::path(testing::TempDir()) / (std::string("voxmelt_library_") + test->name());
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    file = write("scene.toml", kSmallScene);
  }
  ~SceneFile() override { std::filesystem::remove_all(folder); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }

  std::filesystem::path folder, file;
};

// Returns the message of the error of one kind that `work` throws, or "nothing" if it throws none.
template <class Kind, class Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const Kind& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace voxmelt
