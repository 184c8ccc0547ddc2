#include "render/packet/draw_picture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <thread>
#include <utility>
#include <vector>

#include "render/packet/plain_packet.h"
#include "render/packet/tile_boxes.h"
#include "render/packet/visible_area.h"
#include "render/rule/ground.h"

namespace voxmelt::render {
namespace {

constexpr int kTile = 16;  // pixels; work is handed out by tiles

// Holds places and their light, for as many samples as a tile can have.
class Samples {
 public:
  explicit Samples(std::size_t most)
      : across_(most + kMostLanes),
        down_(most + kMostLanes),
        red_(most + kMostLanes),
        green_(most + kMostLanes),
        blue_(most + kMostLanes) {}

  void clear() { count_ = 0; }
  void add(std::int64_t across, std::int64_t down) {
    across_[count_] = static_cast<std::int32_t>(across);
    down_[count_++] = static_cast<std::int32_t>(down);
  }
  // The last packet is filled up with the last sample. A place of an earlier tile may lie outside of what the
  // data of this one are narrowed to.
  void draw(const PictureData& data, const Packets& packets) {
    if (count_ == 0) return;
    std::fill_n(across_.begin() + static_cast<std::ptrdiff_t>(count_), kMostLanes, across_[count_ - 1]);
    std::fill_n(down_.begin() + static_cast<std::ptrdiff_t>(count_), kMostLanes, down_[count_ - 1]);
    packets.draw(data, {across_.data(), down_.data(), count_}, {red_.data(), green_.data(), blue_.data()});
  }
  // Returns the mean of kCount samples, in bytes.
  template <std::size_t kCount>
  Rgb mean(const picture::Bytes& bytes, std::size_t first) const {
    const auto channel = [&](const std::vector<std::uint16_t>& all) {
      std::size_t sum = kCount / 2;
      for (std::size_t i = first; i < first + kCount; ++i) sum += all[i];
      return bytes[sum / kCount];
    };
    return {channel(red_), channel(green_), channel(blue_)};
  }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
  std::vector<std::int32_t> across_, down_;
  std::vector<std::uint16_t> red_, green_, blue_;
};

// Calls work(tile, samples) for every tile, on some threads. Throws Stopped.
template <class Work>
void for_tiles(int tiles, int threads, const Stop& stop, const Work& work) {
  std::atomic<int> next{0};
  std::atomic<bool> stopped{false};
  const auto some = [&] {
    Samples samples(kTile * kTile * picture::kThirtyTwo.size());
    for (int tile = next++; tile < tiles && !stopped; tile = next++) {
      if (stop && stop()) {
        stopped = true;
      } else {
        work(tile, samples);
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < std::min(threads, tiles); ++i) helpers.emplace_back(some);
    some();
  }
  if (stopped) throw Stopped{};
}

struct Tile {
  int x0, y0, x1, y1;
};

// Knows which tiles may show matter or ground.
class Areas {
 public:
  explicit Areas(const PictureData& data)
      : data_(data),
        known_(data.skip && fits_lanes(data)),
        projection_(data.view),
        matter_(data, projection_, kTile),
        ground_(projection_.of(
            {}, {data.ground.cells.x * picture::kCell,
                 std::int64_t{data.ground.highest} << (picture::kPositionBits - picture::kHeightBits),
                 data.ground.cells.z * picture::kCell})) {}

  // Narrows the data to the things to be drawn in a tile. Tells whether there is anything.
  bool in(int index, const Tile& tile, PictureData& data) const {
    data = data_;
    if (!known_) return true;
    const bool matter = matter_.narrow(index, data.field);
    if (!ground_.overlaps(tile.x0 * picture::kPixel, tile.y0 * picture::kPixel, tile.x1 * picture::kPixel,
                          tile.y1 * picture::kPixel))
      data.ground.any = false;
    return data.ground.any || matter;
  }

 private:
  const PictureData& data_;
  const bool known_;  // Projection holds up to 2^20 samples a ray; errors of steps add up
  Projection projection_;
  TileBoxes matter_;
  VisibleArea ground_;
};

// Tells which pixels of a tile's row differ from a neighbour, byte by byte.
class Differing {
 public:
  Differing(const Image& image, const Tile& tile, int y, int most) : most_(most) {
    const int width = tile.x1 - tile.x0;
    const auto row = [&](int j) { return image.at(tile.x0, j).data(); };
    const std::uint8_t* here = row(y);
    if (y > 0) compare(here, row(y - 1), 3 * width);
    if (y + 1 < image.height) compare(here, row(y + 1), 3 * width);
    const int left = tile.x0 > 0 ? 0 : 3, right = tile.x1 < image.width ? 3 * width : 3 * (width - 1);
    compare(here, here - 3, 3 * width, left);
    compare(here, here + 3, right);
  }
  bool operator()(int x) const { return (far_[3 * x] | far_[3 * x + 1] | far_[3 * x + 2]) != 0; }

 private:
  void compare(const std::uint8_t* a, const std::uint8_t* b, int end, int first = 0) {
    for (int i = first; i < end; ++i) far_[i] |= std::abs(a[i] - b[i]) > most_ ? 1 : 0;
  }
  int most_;
  std::uint8_t far_[3 * kTile] = {};
};

// Draws a picture tile by tile, on some threads.
class TiledPicture {
 public:
  TiledPicture(const PictureData& data, const Packets& packets, int threads, const Stop& stop)
      : data_(data),
        packets_(packets),
        threads_(threads),
        stop_(stop),
        areas_(data),
        across_((data.width + kTile - 1) / kTile),
        tiles_(across_ * ((data.height + kTile - 1) / kTile)),
        image_(data.width, data.height, {background(0), background(1), background(2)}) {}

  // Draws one sample a pixel. Packets are small squares, whose rays run together.
  void draw_middles() {
    const int side = packets_.lanes >= 16 ? 4 : packets_.lanes >= 4 ? 2 : 1, wide = packets_.lanes / side;
    for_tiles(tiles_, threads_, stop_, [&](int index, Samples& samples) {
      const Tile tile = tile_at(index);
      PictureData of_tile;
      if (!areas_.in(index, tile, of_tile)) return;
      std::array<std::uint16_t, kTile * kTile> pixel;
      samples.clear();
      for (int y = tile.y0; y < tile.y1; y += side)
        for (int x = tile.x0; x < tile.x1; x += wide)
          for (int j = y; j < std::min(y + side, tile.y1); ++j)
            for (int i = x; i < std::min(x + wide, tile.x1); ++i) {
              pixel[samples.count()] = place_in(tile, i, j);
              samples.add(i * picture::kPixel + picture::kMiddle[0].across,
                          j * picture::kPixel + picture::kMiddle[0].down);
            }
      samples.draw(of_tile, packets_);
      for (std::size_t i = 0; i < samples.count(); ++i)
        pixel_at(tile, pixel[i]) = samples.mean<1>(*data_.bytes, i);
    });
  }

  // Draws more samples for the pixels that differ from a neighbour.
  template <std::size_t kCount>
  void refine(int difference, const std::array<picture::Sub, kCount>& pattern) {
    const Image before = image_;
    for_tiles(tiles_, threads_, stop_, [&](int index, Samples& samples) {
      const Tile tile = tile_at(index);
      std::array<std::uint16_t, kTile * kTile> pixel;
      std::size_t pixels = 0;
      samples.clear();
      for (int y = tile.y0; y < tile.y1; ++y) {
        const Differing differing(before, tile, y, difference);
        for (int x = tile.x0; x < tile.x1; ++x) {
          if (!differing(x - tile.x0)) continue;
          pixel[pixels++] = place_in(tile, x, y);
          for (const picture::Sub& sub : pattern)
            samples.add(x * picture::kPixel + sub.across, y * picture::kPixel + sub.down);
        }
      }
      PictureData of_tile;
      if (pixels == 0 || !areas_.in(index, tile, of_tile)) return;
      samples.draw(of_tile, packets_);
      for (std::size_t i = 0; i < pixels; ++i)
        pixel_at(tile, pixel[i]) = samples.mean<kCount>(*data_.bytes, i * kCount);
    });
  }

  Image take() { return std::move(image_); }

 private:
  std::uint8_t background(std::size_t c) const { return (*data_.bytes)[data_.background[c]]; }
  Tile tile_at(int tile) const {
    const int x = tile % across_ * kTile, y = tile / across_ * kTile;
    return {x, y, std::min(x + kTile, data_.width), std::min(y + kTile, data_.height)};
  }
  static std::uint16_t place_in(const Tile& tile, int x, int y) {
    return static_cast<std::uint16_t>((y - tile.y0) * kTile + (x - tile.x0));
  }
  Rgb& pixel_at(const Tile& tile, std::uint16_t place) {
    return image_.at(tile.x0 + place % kTile, tile.y0 + place / kTile);
  }

  const PictureData& data_;
  const Packets& packets_;
  const int threads_;
  const Stop& stop_;
  const Areas areas_;
  const int across_, tiles_;
  Image image_;
};

}  // namespace

const Packets& packets_of(cpu::InstructionSet wanted) {
  static const auto all = [] {
    std::array<Packets, cpu::kInstructionSets.size()> result{};
    cpu::for_each_instruction_set([&]<cpu::InstructionSet set>() {
      result[static_cast<std::size_t>(set)] = packets_for<cpu::ArchOf<set>>();
    });
    return result;
  }();
  return all[static_cast<std::size_t>(wanted)];
}

const Packets& best_packets() { return packets_of(cpu::widest()); }

// Tells whether rays come to the grid within 2^20 samples. Then their ranges in floats reach no more than
// three samples too far. Places on them are parts of 2^30 at most. Sums in doubles stay below 2^52.
bool fits_lanes(const PictureData& data) {
  const picture::View& view = data.view;
  const std::int64_t most_samples = std::int64_t{1} << 20;
  const std::int64_t most_way = most_samples << (picture::kPositionBits - data.spacing - 1);
  const std::int64_t far = picture::largest(data.field.cells) * picture::kCell;
  const auto axis = [&](std::int64_t eye, std::int64_t forward, std::int64_t wide, std::int64_t high,
                        std::int64_t near_wide, std::int64_t near_high) {
    const auto spread = [&](std::int64_t a, std::int64_t b) {
      return picture::magnitude(a) * view.half_width + picture::magnitude(b) * view.half_height;
    };
    const std::int64_t on_plane = spread(near_wide, near_high);
    return spread(wide, high) + picture::magnitude(forward) * view.half_height < std::int64_t{1} << 52 &&
           on_plane < std::int64_t{1} << 52 &&
           picture::magnitude(eye + ((forward * view.near) >> 14)) + (on_plane >> 10) + far < most_way;
  };
  return axis(view.eye.x, view.forward.x, view.wide.x, view.high.x, view.near_wide.x, view.near_high.x) &&
         axis(view.eye.y, view.forward.y, view.wide.y, view.high.y, view.near_wide.y, view.near_high.y) &&
         axis(view.eye.z, view.forward.z, view.wide.z, view.high.z, view.near_wide.z, view.near_high.z);
}

Image draw_picture(const PictureData& data, Setting setting, const Packets& wanted, int threads,
                   const Stop& stop) {
  TiledPicture picture(data, fits_lanes(data) ? wanted : plain_packets(), threads, stop);
  picture.draw_middles();
  if (setting == Setting::normal) picture.refine(picture::kDifference, picture::kEight);
  if (setting == Setting::best) picture.refine(picture::kFineDifference, picture::kThirtyTwo);
  return picture.take();
}

}  // namespace voxmelt::render
