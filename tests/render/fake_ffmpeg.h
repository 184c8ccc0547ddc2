// Makes a folder with a shell script for `ffmpeg`, the only program on the PATH while the object lives.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "render/image/image.h"

namespace voxmelt {

class FakeFfmpeg {
 public:
  // `script` sees the film's file as $film. The script says that every codec works, except `missing_codec`.
  // If `script` is empty, there is no ffmpeg.
  explicit FakeFfmpeg(const std::string& script, const std::string& missing_codec = "none")
      : old_path_(std::getenv("PATH")), folder_(fresh_folder()) {
    std::filesystem::create_directories(folder_);
    const std::filesystem::path program = folder_ / "ffmpeg";
    if (!script.empty()) {
      std::ofstream(program) << "#!/bin/sh\nPATH=/usr/bin:/bin\n"
                             << "for film; do :; done\ncase \"$*\" in\n*" << missing_codec
                             << "*) exit 1;;\n*/dev/zero*) exit 0;;\nesac\n"
                             << "echo \"$*\" > " << folder_.string() << "/arguments\n"
                             << script << "\n";
      std::filesystem::permissions(program, std::filesystem::perms::all);
    }
    setenv("PATH", folder_.c_str(), 1);
  }
  FakeFfmpeg(const FakeFfmpeg&) = delete;
  FakeFfmpeg& operator=(const FakeFfmpeg&) = delete;
  ~FakeFfmpeg() {
    setenv("PATH", old_path_.c_str(), 1);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  const std::filesystem::path& folder() const { return folder_; }
  std::string arguments() const { return bytes_of(folder_ / "arguments"); }

  static std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  // Returns the bytes that `cat` makes of a frame.
  static std::string raw(const render::Image& image) {
    return {reinterpret_cast<const char*>(image.pixels.data()), sizeof(render::Rgb) * image.pixels.size()};
  }

 private:
  static std::filesystem::path fresh_folder() {
    static int count = 0;
    return std::filesystem::temp_directory_path() /
           ("voxmelt_ffmpeg_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
  }

  std::string old_path_;
  std::filesystem::path folder_;
};

}  // namespace voxmelt
