#include "render/packet/draw_picture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace voxmelt::render {
namespace {

constexpr int kTile = 32;  // pixels; work is handed out by tiles

// Places and their light, for as many samples as a tile can have.
class Samples {
 public:
  explicit Samples(std::size_t most) : across_(most), down_(most), red_(most), green_(most), blue_(most) {}

  void clear() { count_ = 0; }
  void add(std::int64_t across, std::int64_t down) {
    across_[count_] = static_cast<std::int32_t>(across);
    down_[count_++] = static_cast<std::int32_t>(down);
  }
  void draw(const PictureData& data, const Packets& packets) {
    packets.draw(data, {across_.data(), down_.data(), count_}, {red_.data(), green_.data(), blue_.data()});
  }
  // The mean of `count` samples, in bytes.
  Rgb mean(const picture::Bytes& bytes, std::size_t first, std::size_t count) const {
    const auto channel = [&](const std::vector<std::uint16_t>& of) {
      std::size_t sum = count / 2;
      for (std::size_t i = first; i < first + count; ++i) sum += of[i];
      return bytes[sum / count];
    };
    return {channel(red_), channel(green_), channel(blue_)};
  }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
  std::vector<std::int32_t> across_, down_;
  std::vector<std::uint16_t> red_, green_, blue_;
};

// Calls work(tile, samples) for every tile, on some threads.
template <class Work>
void for_tiles(int tiles, int threads, const Work& work) {
  std::atomic<int> next{0};
  const auto some = [&] {
    Samples samples(kTile * kTile * picture::kSixteen.size());
    for (int tile = next++; tile < tiles; tile = next++) work(tile, samples);
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < std::min(threads, tiles); ++i) helpers.emplace_back(some);
  some();
}

struct Tile {
  int x0, y0, x1, y1;
};

}  // namespace

const Packets& packets_of(cpu::InstructionSet wanted) {
  static const auto all = [] {
    std::array<Packets, cpu::kInstructionSets.size()> of{};
    cpu::for_each_instruction_set(
        [&]<cpu::InstructionSet set>() { of[static_cast<std::size_t>(set)] = packets_for<cpu::ArchOf<set>>(); });
    return of;
  }();
  return all[static_cast<std::size_t>(wanted)];
}

const Packets& best_packets() {
  cpu::InstructionSet best{};
  for (const cpu::InstructionSetRow& row : cpu::kInstructionSets)
    if (row.supported()) best = row.set;
  return packets_of(best);
}

Image draw_picture(const PictureData& data, Setting setting, const Packets& packets, int threads) {
  const int width = data.width, height = data.height;
  const int across = (width + kTile - 1) / kTile, tiles = across * ((height + kTile - 1) / kTile);
  const auto tile_at = [&](int tile) {
    const int x = tile % across * kTile, y = tile / across * kTile;
    return Tile{x, y, std::min(x + kTile, width), std::min(y + kTile, height)};
  };
  Image image(width, height);

  // Packets are small squares, whose rays run together.
  const int side = packets.lanes >= 16 ? 4 : 2, wide = packets.lanes / side;
  for_tiles(tiles, threads, [&](int index, Samples& samples) {
    const Tile tile = tile_at(index);
    std::array<std::uint16_t, kTile * kTile> pixel;
    samples.clear();
    for (int y = tile.y0; y < tile.y1; y += side)
      for (int x = tile.x0; x < tile.x1; x += wide)
        for (int j = y; j < std::min(y + side, tile.y1); ++j)
          for (int i = x; i < std::min(x + wide, tile.x1); ++i) {
            pixel[samples.count()] = static_cast<std::uint16_t>((j - tile.y0) * kTile + (i - tile.x0));
            samples.add(i * picture::kPixel + picture::kMiddle[0].across, j * picture::kPixel + picture::kMiddle[0].down);
          }
    samples.draw(data, packets);
    for (std::size_t i = 0; i < samples.count(); ++i)
      image.at(tile.x0 + pixel[i] % kTile, tile.y0 + pixel[i] / kTile) = samples.mean(*data.bytes, i, 1);
  });
  if (setting == Setting::fast) return image;

  const auto refine = [&](int difference, const auto& pattern) {
    const Image before = image;
    for_tiles(tiles, threads, [&](int index, Samples& samples) {
      const Tile tile = tile_at(index);
      std::array<std::uint16_t, kTile * kTile> pixel;
      std::size_t pixels = 0;
      samples.clear();
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
          const auto other = [&](int i, int j) {
            return picture::differ(before.at(x, y), before.at(i, j), difference);
          };
          const bool differs = (x > 0 && other(x - 1, y)) || (x + 1 < width && other(x + 1, y)) ||
                               (y > 0 && other(x, y - 1)) || (y + 1 < height && other(x, y + 1));
          if (!differs) continue;
          pixel[pixels++] = static_cast<std::uint16_t>((y - tile.y0) * kTile + (x - tile.x0));
          for (const picture::Sub& sub : pattern)
            samples.add(x * picture::kPixel + sub.across, y * picture::kPixel + sub.down);
        }
      if (pixels == 0) return;
      samples.draw(data, packets);
      for (std::size_t i = 0; i < pixels; ++i)
        image.at(tile.x0 + pixel[i] % kTile, tile.y0 + pixel[i] / kTile) =
            samples.mean(*data.bytes, i * pattern.size(), pattern.size());
    });
  };
  refine(picture::kDifference, picture::kFour);
  if (setting == Setting::best) refine(picture::kFineDifference, picture::kSixteen);
  return image;
}

}  // namespace voxmelt::render
