#include "render/image/png_bytes.h"

#include <zlib.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string_view>
#include <vector>

namespace voxmelt::render {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Measured on frames of all looks: higher levels cost time and save little; lower ones take a third more
// bytes.
constexpr int kLevel = 3;

void append_number(std::string& text, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(number >> shift & 0xFF);
}

void append_chunk(std::string& file, std::string_view name, std::string_view data) {
  append_number(file, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = file.size();
  file.append(name).append(data);
  append_number(file, static_cast<std::uint32_t>(crc32_z(
                          0, reinterpret_cast<const Bytef*>(file.data() + begin), file.size() - begin)));
}

// Compresses what it is given, piece by piece.
class Deflater {
 public:
  Deflater() {
    if (deflateInit2(&stream_, kLevel, Z_DEFLATED, 15, 8, Z_FILTERED) != Z_OK) throw std::bad_alloc();
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  ~Deflater() { deflateEnd(&stream_); }

  void add(const Bytes& bytes, bool last) {
    stream_.next_in = const_cast<Bytef*>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(buffer_.data());
      stream_.avail_out = static_cast<uInt>(buffer_.size());
      deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH);
      packed_.append(buffer_.data(), buffer_.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }
  const std::string& packed() const { return packed_; }

 private:
  z_stream stream_{};
  std::array<char, 16384> buffer_;
  std::string packed_;
};

// The sum of the differences as magnitudes guesses well which of two filters packs better.
int magnitude(std::uint8_t difference) { return std::abs(static_cast<std::int8_t>(difference)); }

// PNG's filters 1 and 2: the differences to the pixel on the left, or to that above, whichever are smaller.
void filter_row(const Bytes& row, const Bytes& above, std::size_t pixel, Bytes& left, Bytes& up) {
  int left_sum = 0, up_sum = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::uint8_t before = i < pixel ? std::uint8_t{0} : row[i - pixel];
    left[i + 1] = static_cast<std::uint8_t>(row[i] - before);
    left_sum += magnitude(left[i + 1]);
  }
  for (std::size_t i = 0; i < row.size(); ++i) {
    up[i + 1] = static_cast<std::uint8_t>(row[i] - above[i]);
    up_sum += magnitude(up[i + 1]);
  }
  left[0] = 1;
  up[0] = 2;
  if (up_sum < left_sum) left.swap(up);
}

struct Format {
  int width, height;
  char depth, color;
  std::size_t pixel;  // bytes
};

// read_row(y, row) gives the bytes of a row.
template <class ReadRow>
std::string file_bytes(const Format& format, bool colors, const ReadRow& read_row) {
  std::string file = "\x89PNG\r\n\x1a\n", header;
  append_number(header, static_cast<std::uint32_t>(format.width));
  append_number(header, static_cast<std::uint32_t>(format.height));
  header += {format.depth, format.color, 0, 0, 0};
  append_chunk(file, "IHDR", header);
  if (colors) append_chunk(file, "sRGB", std::string_view("\0", 1));

  const std::size_t bytes = static_cast<std::size_t>(format.width) * format.pixel;
  Bytes row(bytes), above(bytes), filtered(bytes + 1), other(bytes + 1);
  Deflater deflater;
  for (int y = 0; y < format.height; ++y) {
    row.swap(above);
    read_row(y, row);
    filter_row(row, above, format.pixel, filtered, other);
    deflater.add(filtered, y + 1 == format.height);
  }
  append_chunk(file, "IDAT", deflater.packed());
  append_chunk(file, "IEND", {});
  return file;
}

}  // namespace

std::string png_bytes(const Image& image) {
  return file_bytes({image.width, image.height, 8, 2, 3}, true, [&](int y, Bytes& row) {
    const std::uint8_t* const from = image.at(0, y).data();
    row.assign(from, from + row.size());
  });
}

std::string png_bytes(const Image16& image) {
  const char color = image.channels == 1 ? 0 : 2;
  const Format format{image.width, image.height, 16, color, 2 * static_cast<std::size_t>(image.channels)};
  return file_bytes(format, false, [&](int y, Bytes& row) {
    const std::size_t numbers = row.size() / 2;
    for (std::size_t i = 0; i < numbers; ++i) {  // the high byte comes first
      const std::uint16_t number = image.numbers[static_cast<std::size_t>(y) * numbers + i];
      row[2 * i] = static_cast<std::uint8_t>(number >> 8);
      row[2 * i + 1] = static_cast<std::uint8_t>(number & 0xFF);
    }
  });
}

}  // namespace voxmelt::render
