#include "render/image/png.h"

#include <png.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#include "render/image/png_bytes.h"

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

// Writes a file beside the target and renames it.
void write_beside(const std::filesystem::path& file, const std::string& bytes) {
  std::error_code unknown;
  if (std::filesystem::is_symlink(file, unknown) ||
      (std::filesystem::exists(file, unknown) && !std::filesystem::is_regular_file(file, unknown)))
    fail(file, "is not a file that a picture could replace");
  std::filesystem::path beside = file;
  beside += ".part-" + std::to_string(::getpid());
  File stream(std::fopen(beside.c_str(), "wb"));
  if (!stream) fail_errno(file, "cannot be written", errno);

  int code = std::fwrite(bytes.data(), 1, bytes.size(), stream.get()) == bytes.size() ? 0 : errno;
  if (std::fclose(stream.release()) != 0 && code == 0) code = errno;
  std::error_code renamed;
  if (code == 0) std::filesystem::rename(beside, file, renamed);
  if (code == 0 && !renamed) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  if (code != 0) fail_errno(file, "cannot be written", code);
  fail(file, "cannot be renamed from " + beside.string() + ": " + renamed.message());
}

// Reads a PNG file. Its size is known once it is open.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file), stream_(std::fopen(file.c_str(), "rb")) {
    if (!stream_) fail_errno(file, "cannot be read", errno);
    header_.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_stdio(&header_, stream_.get())) fail(file, header_.message);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_image_free(&header_); }

  int width() const { return header_.width; }
  int height() const { return header_.height; }
  png_uint_32 format() const { return header_.format; }

  void read(png_uint_32 format, void* pixels) {
    header_.format = format;
    if (!png_image_finish_read(&header_, nullptr, pixels, 0, nullptr)) fail(file_, header_.message);
  }

 private:
  const std::filesystem::path& file_;
  File stream_;
  png_image header_{};
};

}  // namespace

void write_png(const std::filesystem::path& file, const Image& image) {
  write_beside(file, png_bytes(image));
}

void write_png(const std::filesystem::path& file, const Image16& image) {
  write_beside(file, png_bytes(image));
}

Image read_png(const std::filesystem::path& file) {
  Reader reader(file);
  Image image(reader.width(), reader.height());
  reader.read(PNG_FORMAT_RGB, image.pixels.data());
  return image;
}

Image16 read_png16(const std::filesystem::path& file) {
  Reader reader(file);
  if ((reader.format() & PNG_FORMAT_FLAG_LINEAR) == 0) fail(file, "has no 16-bit numbers");
  const bool colors = (reader.format() & PNG_FORMAT_FLAG_COLOR) != 0;
  Image16 image(reader.width(), reader.height(), colors ? 3 : 1);
  reader.read(colors ? PNG_FORMAT_LINEAR_RGB : PNG_FORMAT_LINEAR_Y, image.numbers.data());
  return image;
}

}  // namespace voxmelt::render
