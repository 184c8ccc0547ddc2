// Pictures are written to PNG files, and read from them.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "render/image/image.h"

namespace voxmelt::render {

// A picture could not be written or read. The message names the file and the system's reason.
class ImageError : public std::runtime_error {
 public:
  explicit ImageError(const std::string& message, bool out_of_space = false)
      : std::runtime_error(message), out_of_space_(out_of_space) {}
  bool out_of_space() const { return out_of_space_; }

 private:
  bool out_of_space_;
};

// Writes beside the target and renames, so a reader never sees half a file. Throws ImageError.
void write_png(const std::filesystem::path& file, const Image& image);
void write_png(const std::filesystem::path& file, const Image16& image);

// Reads any PNG as 8-bit RGB. Throws ImageError.
Image read_png(const std::filesystem::path& file);

// Reads a PNG of 16-bit numbers, grey or RGB, as they are stored. Throws ImageError.
Image16 read_png16(const std::filesystem::path& file);

}  // namespace voxmelt::render
