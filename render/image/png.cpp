#include "render/image/png.h"

#include <png.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

namespace voxmelt::render {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw ImageError(file.string() + ": error: " + what);
}

[[noreturn]] void fail_errno(const std::filesystem::path& file, const std::string& what, int code) {
  throw ImageError(file.string() + ": error: " + what + ": " + std::strerror(code),
                   code == ENOSPC || code == EDQUOT);
}

}  // namespace

void write_png(const std::filesystem::path& file, const Image& image) {
  std::error_code unknown;
  if (std::filesystem::is_symlink(file, unknown) ||
      (std::filesystem::exists(file, unknown) && !std::filesystem::is_regular_file(file, unknown)))
    fail(file, "is not a file that a picture could replace");
  std::filesystem::path beside = file;
  beside += ".part-" + std::to_string(::getpid());
  File stream(std::fopen(beside.c_str(), "wb"));
  if (!stream) fail_errno(file, "cannot be written", errno);

  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  errno = 0;
  const bool encoded =
      png_image_write_to_stdio(&header, stream.get(), 0, image.pixels.data(), 0, nullptr) != 0;
  const int code = errno;
  const bool flushed = std::fclose(stream.release()) == 0;
  if (!encoded || !flushed) {
    const int reason = encoded ? errno : code;
    const std::string what = header.message[0] != '\0' ? header.message : "cannot be written";
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    if (reason != 0) fail_errno(file, what, reason);
    fail(file, what);
  }

  std::error_code renamed;
  std::filesystem::rename(beside, file, renamed);
  if (renamed) fail(file, "cannot be renamed from " + beside.string() + ": " + renamed.message());
}

Image read_png(const std::filesystem::path& file) {
  File stream(std::fopen(file.c_str(), "rb"));
  if (!stream) fail_errno(file, "cannot be read", errno);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_stdio(&header, stream.get())) fail(file, header.message);
  header.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height));
  if (!png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr)) {
    const std::string what = header.message;
    png_image_free(&header);
    fail(file, what);
  }
  return image;
}

}  // namespace voxmelt::render
