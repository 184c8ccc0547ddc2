// GeoTIFF files of elevations hold one band of integers or floating-point numbers, in strips or tiles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/scene/shape/heightfield.h"
#include "kernel/scene/shape/tiff_file.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 30;
constexpr double kUsualNoData = -9999;  // if no tag names another

// Tags of GeoTIFF, and of GDAL.
constexpr std::uint32_t kPixelScale = 33550, kTransformation = 34264, kNoData = 42113;

// Says how many bytes a byte of the file can become. Others are not read: they lose bits, or are rare.
struct Packing {
  int code;
  std::size_t most_times;
};
constexpr std::array kPackings{
    Packing{COMPRESSION_NONE, 1},       Packing{COMPRESSION_PACKBITS, 64},
    Packing{COMPRESSION_LZW, 4096},     Packing{COMPRESSION_ADOBE_DEFLATE, 1032},
    Packing{COMPRESSION_DEFLATE, 1032}, Packing{COMPRESSION_LZMA, 32768},
    Packing{COMPRESSION_ZSTD, 32768},
};

// Describes the numbers of a file.
struct Layout {
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t wide = 0, high = 0;  // of a tile, or of a strip
  bool is_tiled = false;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::size_t bytes = 1;  // of a number
  std::size_t most_times = 1;
};

template <class Number>
double number_in(const std::byte* at) {
  Number number;
  std::memcpy(&number, at, sizeof number);
  return static_cast<double>(number);
}

double number_at(const std::byte* at, const Layout& layout) {
  const bool is_real = layout.format == SAMPLEFORMAT_IEEEFP, is_signed = layout.format == SAMPLEFORMAT_INT;
  switch (layout.bytes) {
    case 1:
      return is_signed ? number_in<std::int8_t>(at) : number_in<std::uint8_t>(at);
    case 2:
      return is_signed ? number_in<std::int16_t>(at) : number_in<std::uint16_t>(at);
    case 4:
      if (is_real) return number_in<float>(at);
      return is_signed ? number_in<std::int32_t>(at) : number_in<std::uint32_t>(at);
    default:
      if (is_real) return number_in<double>(at);
      return is_signed ? number_in<std::int64_t>(at) : number_in<std::uint64_t>(at);
  }
}

class TiffReader {
 public:
  TiffReader(const std::filesystem::path& file, const Place& place)
      : file_(file.string()), place_(place), tiff_(read_text_file(file, kLargestFile, place.text())) {
    if (tiff_.get() == nullptr) refuse("no TIFF: " + tiff_.problem());
  }

  Elevation read() {
    read_layout();
    read_scale();
    read_no_data();
    elevation_.columns = static_cast<int>(layout_.columns);
    elevation_.rows = static_cast<int>(layout_.rows);
    elevation_.value.reserve(std::size_t{layout_.columns} * layout_.rows);
    for (std::uint32_t row = 0; row < layout_.rows; row += layout_.high) read_band(row);
    if (is_upside_down_) turn_over();
    if (!fill_missing(elevation_)) refuse("every cell is without data");
    return std::move(elevation_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { fail_at(place_, file_ + ": " + why); }

  void read_layout() {
    layout_.columns = tiff_.tag<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
    layout_.rows = tiff_.tag<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
    for (const std::uint32_t side : {layout_.columns, layout_.rows})
      if (side < 2 || side > kLargestElevationSide)
        refuse(fmt::format("a side of {} cells is outside 2..{}", side, kLargestElevationSide));
    if (const int bands = tiff_.tag<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1); bands != 1)
      refuse(
          fmt::format("it has {} bands, and heights are one; `gdal_translate -b 1` takes the first", bands));
    if (tiff_.tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK) > PHOTOMETRIC_MINISBLACK)
      refuse("heights are grey, and this one has colours");
    read_kind_of_numbers();

    const int code = tiff_.tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    const auto* const packing = std::ranges::find(kPackings, code, &Packing::code);
    if (packing == kPackings.end() || TIFFIsCODECConfigured(static_cast<std::uint16_t>(code)) == 0)
      refuse(fmt::format("its compression {} is not read; `gdal_translate -co COMPRESS=DEFLATE` converts it",
                         code));
    layout_.most_times = packing->most_times;

    layout_.is_tiled = TIFFIsTiled(tiff_.get()) != 0;
    layout_.wide = layout_.is_tiled ? tiff_.tag<std::uint32_t>(TIFFTAG_TILEWIDTH, 0) : layout_.columns;
    layout_.high = layout_.is_tiled
                       ? tiff_.tag<std::uint32_t>(TIFFTAG_TILELENGTH, 0)
                       : std::min(layout_.rows, tiff_.tag<std::uint32_t>(TIFFTAG_ROWSPERSTRIP, 0));
    for (const std::uint32_t side : {layout_.wide, layout_.high})
      if (side < 1 || side > kLargestElevationSide)
        refuse(fmt::format("a side of a tile or strip is {}, outside 1..{}", side, kLargestElevationSide));
  }

  void read_kind_of_numbers() {
    layout_.format = tiff_.tag<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    if (layout_.format == SAMPLEFORMAT_VOID) layout_.format = SAMPLEFORMAT_UINT;
    const int bits = tiff_.tag<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
    const bool is_real = layout_.format == SAMPLEFORMAT_IEEEFP;
    const bool is_integer = layout_.format == SAMPLEFORMAT_UINT || layout_.format == SAMPLEFORMAT_INT;
    if (!(is_real && (bits == 32 || bits == 64)) &&
        !(is_integer && (bits == 8 || bits == 16 || bits == 32 || bits == 64)))
      refuse(fmt::format("numbers of {} bits{} are not read; `gdal_translate -ot Float32` converts it", bits,
                         is_real      ? ", floating-point,"
                         : is_integer ? ""
                                      : ", complex or of no known kind,"));
    layout_.bytes = static_cast<std::size_t>(bits) / 8;
  }

  void read_scale() {
    const auto [scale, of_scale] = tiff_.foreign_tag<double>(kPixelScale, TIFF_DOUBLE);
    const auto [matrix, of_matrix] = tiff_.foreign_tag<double>(kTransformation, TIFF_DOUBLE);
    double x = 1, y = -1;
    if (of_scale >= 2) {
      x = scale[0];
      y = -std::abs(scale[1]);  // as GDAL takes it
    } else if (of_matrix == 16) {
      if (matrix[1] != 0 || matrix[4] != 0) refuse("its map is turned; `gdalwarp` makes one that is not");
      x = matrix[0];
      y = matrix[5];
    }
    if (!(x > 0) || !std::isfinite(x) || y == 0 || !std::isfinite(y))
      refuse(fmt::format("cells of {:g} x {:g} are no size", x, std::abs(y)));
    elevation_.cell_x = x;
    elevation_.cell_y = std::abs(y);
    is_upside_down_ = y > 0;
  }

  void read_no_data() {
    const auto [text, size] = tiff_.foreign_tag<char>(kNoData, TIFF_ASCII);
    if (text == nullptr) return;
    elevation_.names_missing = true;
    std::string_view word(text, size);
    word = word.substr(0, word.find('\0'));
    while (word.ends_with(' ')) word.remove_suffix(1);
    while (word.starts_with(' ')) word.remove_prefix(1);
    if (word == "nan" || word == "NaN" || word == "-nan") return;
    no_data_ = real_number_in(word);
    if (!no_data_) refuse("its no-data tag has " + in_quotes(word) + ", which is no number");
  }

  // A band is as high as a tile or a strip.
  void read_band(std::uint32_t first_row) {
    const std::uint32_t rows = std::min(layout_.high, layout_.rows - first_row);
    for (std::uint32_t column = 0; column < layout_.columns; column += layout_.wide)
      read_part(column, first_row, rows);
  }

  void read_part(std::uint32_t first_column, std::uint32_t first_row, std::uint32_t rows) {
    const std::uint32_t number = layout_.is_tiled
                                     ? TIFFComputeTile(tiff_.get(), first_column, first_row, 0, 0)
                                     : TIFFComputeStrip(tiff_.get(), first_row, 0);
    // A tile at the border is whole, and a strip is not.
    const std::size_t wanted =
        std::size_t{layout_.wide} * (layout_.is_tiled ? layout_.high : rows) * layout_.bytes;
    const std::size_t packed =
        std::min<std::uint64_t>(TIFFGetStrileByteCount(tiff_.get(), number), tiff_.size());
    if (packed == 0) return left_out(first_column, first_row, rows);
    if (wanted > packed * layout_.most_times) refuse("it is too short for its cells: is it truncated?");
    if (wanted > room_size_) room_ = std::make_unique_for_overwrite<std::byte[]>(room_size_ = wanted);

    const auto size = static_cast<tmsize_t>(wanted);
    const tmsize_t found = layout_.is_tiled ? TIFFReadEncodedTile(tiff_.get(), number, room_.get(), size)
                                            : TIFFReadEncodedStrip(tiff_.get(), number, room_.get(), size);
    if (found != size) refuse("its data are damaged: " + tiff_.problem());
    make_room(first_row + rows);
    const std::uint32_t columns = std::min(layout_.wide, layout_.columns - first_column);
    for (std::uint32_t y = 0; y < rows; ++y)
      for (std::uint32_t x = 0; x < columns; ++x)
        put(first_column + x, first_row + y,
            number_at(&room_[(std::size_t{y} * layout_.wide + x) * layout_.bytes], layout_));
  }

  // Memory is taken only for what was in the file.
  void make_room(std::uint32_t rows) {
    elevation_.value.resize(std::max(elevation_.value.size(), elevation_.place(0, rows)), kNoElevation);
  }

  // GDAL leaves out a part that has nothing but no-data, or zeros where no tag names it.
  void left_out(std::uint32_t first_column, std::uint32_t first_row, std::uint32_t rows) {
    make_room(first_row + rows);
    if (elevation_.names_missing) return;
    const std::uint32_t columns = std::min(layout_.wide, layout_.columns - first_column);
    for (std::uint32_t y = 0; y < rows; ++y)
      for (std::uint32_t x = 0; x < columns; ++x) put(first_column + x, first_row + y, 0);
  }

  void put(std::uint32_t column, std::uint32_t row, double height) {
    if (std::isnan(height)) return;
    if (is_missing(height)) {
      elevation_.unnamed += elevation_.names_missing ? 0 : 1;
      return;
    }
    if (std::abs(height) > kHighestElevation)
      refuse(
          fmt::format("{:g} in column {}, row {} is no elevation; where it means that there is none, the "
                      "no-data tag must name it (`gdal_translate -a_nodata`)",
                      height, column, row));
    elevation_.value[elevation_.place(column, row)] = height;
  }

  // The tag has decimals, and a number of 32 bits may be another one.
  bool is_missing(double height) const {
    if (!elevation_.names_missing) return height == kUsualNoData;
    if (!no_data_) return false;
    if (height == *no_data_) return true;
    return layout_.format == SAMPLEFORMAT_IEEEFP && layout_.bytes == 4 &&
           std::abs(*no_data_) <= std::numeric_limits<float>::max() &&
           height == static_cast<float>(*no_data_);
  }

  void turn_over() {
    for (std::uint32_t r = 0; r < layout_.rows / 2; ++r)
      for (std::uint32_t c = 0; c < layout_.columns; ++c)
        std::swap(elevation_.value[elevation_.place(c, r)],
                  elevation_.value[elevation_.place(c, layout_.rows - 1 - r)]);
  }

  const std::string file_;
  const Place& place_;
  TiffFile tiff_;
  Layout layout_;
  Elevation elevation_;
  std::optional<double> no_data_;
  bool is_upside_down_ = false;  // its rows go from south to north
  std::unique_ptr<std::byte[]> room_;
  std::size_t room_size_ = 0;
};

}  // namespace

bool tiff_is_built_in() { return true; }

Elevation read_tiff_heights(const std::filesystem::path& file, const Place& place) {
  return TiffReader(file, place).read();
}

}  // namespace voxmelt::scene
