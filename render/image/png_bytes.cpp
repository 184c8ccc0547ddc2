#include "render/image/png_bytes.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "render/image/zlib_bytes.h"

namespace voxmelt::render {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append_number(std::string& text, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(number >> shift & 0xFF);
}

void append_chunk(std::string& file, std::string_view name, std::string_view data) {
  append_number(file, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = file.size();
  file.append(name).append(data);
  append_number(file, libdeflate_crc32(0, file.data() + begin, file.size() - begin));
}

// Writes the differences of two rows. Returns the sum of their magnitudes, which predicts well how they pack.
int differences(const std::uint8_t* row, const std::uint8_t* other, std::size_t bytes, std::uint8_t* to) {
  int sum = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    to[i] = static_cast<std::uint8_t>(row[i] - other[i]);
    sum += std::abs(static_cast<std::int8_t>(to[i]));
  }
  return sum;
}

struct Format {
  int width, height;
  char depth, color;
  std::size_t pixel;  // bytes in a pixel
};

// Returns the bytes of the file. read_row(y, to) writes the bytes of a row.
template <class ReadRow>
std::string file_bytes(const Format& format, bool colors, const ReadRow& read_row) {
  std::string file = "\x89PNG\r\n\x1a\n", header;
  append_number(header, format.width);
  append_number(header, format.height);
  header += {format.depth, format.color, 0, 0, 0};
  append_chunk(file, "IHDR", header);
  if (colors) append_chunk(file, "sRGB", std::string_view("\0", 1));

  // A row begins with a pixel of zeros. PNG's filter 1 subtracts the pixel on the left, and filter 2 the one
  // above.
  const std::size_t bytes = format.width * format.pixel;
  Bytes row(format.pixel + bytes), above(format.pixel + bytes), by_above(bytes);
  Bytes filtered(format.height * (bytes + 1));
  for (int y = 0; y < format.height; ++y) {
    row.swap(above);
    std::uint8_t* const begin = row.data() + format.pixel;
    read_row(y, begin);
    std::uint8_t* const to = filtered.data() + y * (bytes + 1);
    const int left = differences(begin, row.data(), bytes, to + 1);
    const int up = differences(begin, above.data() + format.pixel, bytes, by_above.data());
    const bool take_up = up < left;
    to[0] = take_up ? 2 : 1;
    if (take_up) std::copy(by_above.begin(), by_above.end(), to + 1);
  }
  append_chunk(file, "IDAT", zlib_bytes({reinterpret_cast<const char*>(filtered.data()), filtered.size()}));
  append_chunk(file, "IEND", {});
  return file;
}

}  // namespace

std::string png_bytes(const Image& image) {
  return file_bytes({image.width, image.height, 8, 2, 3}, true, [&](int y, std::uint8_t* row) {
    const auto* const from = reinterpret_cast<const std::uint8_t*>(&image.at(0, y));
    std::copy_n(from, sizeof(Rgb) * image.width, row);
  });
}

std::string png_bytes(const Image16& image) {
  const char color = image.channels == 1 ? 0 : 2;
  const std::size_t channels = image.channels;
  const std::size_t numbers = channels * image.width;
  const Format format{image.width, image.height, 16, color, 2 * channels};
  return file_bytes(format, false, [&](int y, std::uint8_t* row) {
    const std::uint16_t* const from = image.numbers.data() + y * numbers;
    for (std::size_t i = 0; i < numbers; ++i) {  // the high byte comes first
      row[2 * i] = static_cast<std::uint8_t>(from[i] >> 8);
      row[2 * i + 1] = static_cast<std::uint8_t>(from[i] & 0xFF);
    }
  });
}

}  // namespace voxmelt::render
