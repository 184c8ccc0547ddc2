// Pictures of heights: grey PNG files, whose numbers are elevations just as they are stored.
#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/shape/heightfield.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestPicture = std::size_t{1} << 30;  // bytes of the file
constexpr std::size_t kMostTimes = 1032;                       // what a byte of a PNG can become

// Holds what libpng reads and finds. Its errors jump, so nothing here is made or freed meanwhile.
struct Reading {
  std::string_view bytes;  // left to be read
  std::string problem;
  png_uint_32 width = 0, height = 0;
  int depth = 0, color = 0;
  std::size_t row_bytes = 0;
  bool has_transparent = false;
  png_uint_16 transparent = 0;  // the number that stands for nothing
  std::vector<png_byte> pixels;
  std::vector<png_bytep> rows;
};

void take(png_structp png, png_bytep to, std::size_t size) {
  auto* const reading = static_cast<Reading*>(png_get_io_ptr(png));
  if (size > reading->bytes.size()) png_error(png, "it is truncated");
  std::memcpy(to, reading->bytes.data(), size);
  reading->bytes.remove_prefix(size);
}

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  static_cast<Reading*>(png_get_error_ptr(png))->problem = message;
  png_longjmp(png, 1);
}

void pass_over(png_structp, png_const_charp) {}

// libpng, from its beginning to its end.
class Png {
 public:
  explicit Png(Reading& reading)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, fail, pass_over)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)),
        reading_(reading) {}
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool is_there() const { return info_ != nullptr; }

  // They return false where libpng has a problem.
  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &reading_, take);
    png_read_info(png_, info_);
    png_get_IHDR(png_, info_, &reading_.width, &reading_.height, &reading_.depth, &reading_.color, nullptr,
                 nullptr, nullptr);
    png_color_16p transparent = nullptr;
    if (png_get_tRNS(png_, info_, nullptr, nullptr, &transparent) != 0 && transparent != nullptr) {
      reading_.has_transparent = true;
      reading_.transparent = transparent->gray;
    }
    if (reading_.depth < 8) png_set_packing(png_);  // a byte for each number, which stays what it is
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    reading_.row_bytes = png_get_rowbytes(png_, info_);
    return true;
  }
  bool read_rows() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, reading_.rows.data());
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  png_structp png_;
  png_infop info_;
  Reading& reading_;
};

// The numbers of a row lie behind one another, the higher byte of one first. An alpha may follow each.
void add_row(const Reading& reading, const png_byte* row, Elevation& elevation) {
  const std::size_t bytes = reading.depth == 16 ? 2 : 1;
  const bool has_alpha = reading.color == PNG_COLOR_TYPE_GRAY_ALPHA;
  const auto number = [&](const png_byte* at) { return bytes == 2 ? at[0] * 256 + at[1] : int{at[0]}; };
  for (png_uint_32 x = 0; x < reading.width; ++x) {
    const int height = number(row);
    const bool is_nothing =
        (has_alpha && number(row + bytes) == 0) || (reading.has_transparent && height == reading.transparent);
    elevation.value.push_back(is_nothing ? kNoElevation : height);
    row += has_alpha ? 2 * bytes : bytes;
  }
}

}  // namespace

Elevation read_png_heights(const std::filesystem::path& file, const Place& place) {
  const std::string bytes = read_text_file(file, kLargestPicture, place.text());
  const auto refuse = [&](const std::string& why) {
    fail_at(place, fmt::format("{}: {}", file.string(), why));
  };
  Reading reading;
  reading.bytes = bytes;
  Png png(reading);
  if (!png.is_there()) refuse("libpng is another version than the one of its headers");
  if (!png.read_header()) refuse("no PNG picture: " + reading.problem);
  if (reading.color != PNG_COLOR_TYPE_GRAY && reading.color != PNG_COLOR_TYPE_GRAY_ALPHA)
    refuse("a picture of heights is grey, and this one has colours");
  for (const png_uint_32 side : {reading.width, reading.height})
    if (side < 2 || side > kLargestElevationSide)
      refuse(fmt::format("a side of {} pixels is outside 2..{}", side, kLargestElevationSide));
  if (reading.row_bytes * reading.height / kMostTimes / 8 > bytes.size())
    refuse("it is too short for its pixels: is it truncated?");

  reading.pixels.resize(reading.row_bytes * reading.height);
  for (png_uint_32 y = 0; y < reading.height; ++y)
    reading.rows.push_back(&reading.pixels[y * reading.row_bytes]);
  if (!png.read_rows()) refuse("no PNG picture: " + reading.problem);

  Elevation elevation;
  elevation.columns = static_cast<int>(reading.width);
  elevation.rows = static_cast<int>(reading.height);
  elevation.names_missing = true;
  elevation.value.reserve(std::size_t{reading.width} * reading.height);
  for (const png_bytep row : reading.rows) add_row(reading, row, elevation);
  if (!fill_missing(elevation)) refuse("every pixel is without data");
  return elevation;
}

}  // namespace voxmelt::scene
