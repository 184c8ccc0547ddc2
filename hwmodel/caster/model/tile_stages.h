// Tile stages find the pixels of a tile that are to be drawn, gather the samples of a pixel, and return the
// bytes to memory (docs/picture/definition.md, section 10).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <vector>

#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

inline constexpr int kTilePixels = kTileSide * kTileSide;
inline constexpr int kTileBytes = 3 * kTilePixels;  // row by row: red, green, blue
using TileBytes = std::array<std::uint8_t, kTileBytes>;

// A frame lies in memory tile by tile, row by row. The second pass reads the first frame and writes another
// one.
struct FrameRegisters {
  std::int64_t read = 0, write = 0;  // addresses
  int tiles_x = 0, tiles_y = 0;
  int samples = 8, most = 16;  // second pass, for pixels that differ by more than `most`
  Window window;

  std::int64_t address(std::int64_t frame, int tile_x, int tile_y) const {
    return frame + (std::int64_t{tile_y} * tiles_x + tile_x) * kTileBytes;
  }
};

struct TileBuffer {
  TileJob job;
  int samples = 1, left = 0;  // left: pixels that are not complete
  std::array<Rgb, kTilePixels> sums{};
  std::array<std::uint8_t, kTilePixels> counts{};
  TileBytes bytes{};
};
struct TileBuffers {
  explicit TileBuffers(int count) : all(count) {
    for (int i = count - 1; i >= 0; --i) free.push_back(i);
  }
  TileBuffer& at(int i) { return all[i]; }
  std::vector<TileBuffer> all;
  std::vector<int> free;
  std::deque<int> complete;  // numbers of buffers to be written
};

// Gives a tile its buffer, and finds its pixels. In the second pass it reads the tile and the four beside it.
template <class Faults = NoFaults>
class TileStage final : public Stage, public LineClient {
 public:
  TileStage(const Registers& registers, const FrameRegisters& frame, TileBuffers& buffers, int client,
            Faults faults = {})
      : Stage("tiles"),
        registers_(registers),
        frame_(frame),
        faults_(faults),
        buffers_(buffers),
        client_(client) {}
  void connect(Fifo<TileJob>& in, Fifo<LineRequest>& ask, Fifo<TileOrder>& out) {
    in_ = &in;
    ask_ = &ask;
    out_ = &out;
  }
  void arrived(const LineReply& reply, const std::uint8_t* bytes) override {
    std::memcpy(around_[reply.slot].data(), bytes, kTileBytes);
    --missing_;
  }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    const TileJob& job = *in_->oldest();
    if (job.second && asked_ < 5) {  // the tile itself, and those on its left, right, above and below
      const auto [x, y] = beside(job, asked_);
      if (x < 0 || y < 0 || x >= frame_.tiles_x || y >= frame_.tiles_y) {
        ++asked_;
        return Did::busy;
      }
      if (!ask_->ready()) return Did::memory;
      *ask_->put() = {client_, asked_++, frame_.address(frame_.read, x, y), kTileBytes, false, {}};
      ++missing_;
      return Did::busy;
    }
    if (missing_ > 0) return Did::memory;
    if (buffers_.free.empty() || !out_->ready()) return Did::blocked;
    std::uint64_t pixels = pixels_of(job, frame_.most, kBeside);
    faults_.chosen(
        job, frame_.most, [&](int most, unsigned beside) { return pixels_of(job, most, beside); }, pixels);
    const int i = buffers_.free.back();
    buffers_.free.pop_back();
    TileBuffer& buffer = buffers_.at(i);
    buffer.job = job;
    buffer.samples = job.second ? frame_.samples : 1;
    buffer.left = std::popcount(pixels);
    buffer.sums.fill({});
    buffer.counts.fill(0);
    buffer.bytes = job.second ? around_[0] : TileBytes{};
    if (pixels == 0)
      buffers_.complete.push_back(i);
    else
      *out_->put() = {job.x, job.y, i, buffer.samples, pixels};
    in_->get();
    asked_ = 0;
    return Did::busy;
  }

  struct At {
    int x, y;
  };
  static At beside(const TileJob& job, int which) {
    constexpr std::array<int, 5> kX{0, -1, 1, 0, 0}, kY{0, 0, 0, -1, 1};
    const std::size_t i = which;
    return {job.x / kTileSide + kX[i], job.y / kTileSide + kY[i]};
  }
  // There is a bit for each neighbour: left, right, above, below.
  static constexpr unsigned kBeside = 15;
  std::uint64_t pixels_of(const TileJob& job, int most, unsigned beside) const {
    std::uint64_t pixels = 0;
    for (int y = 0; y < kTileSide; ++y)
      for (int x = 0; x < kTileSide; ++x)
        if (is_in(job, x, y) && frame_.window.holds(job.x + x, job.y + y) &&
            (!job.second || differs(job, x, y, most, beside)))
          pixels |= std::uint64_t{1} << (y * kTileSide + x);
    return pixels;
  }
  bool is_in(const TileJob& job, int x, int y) const {
    const int px = job.x + x, py = job.y + y;
    return px >= 0 && py >= 0 && px < registers_.camera.width && py < registers_.camera.height;
  }
  const std::uint8_t* pixel(int x, int y) const {
    const std::size_t tile = x < 0 ? 1 : x >= kTileSide ? 2 : y < 0 ? 3 : y >= kTileSide ? 4 : 0;
    return around_[tile].data() + 3 * ((y & (kTileSide - 1)) * kTileSide + (x & (kTileSide - 1)));
  }
  bool differs(const TileJob& job, int x, int y, int most, unsigned beside) const {
    const std::uint8_t* here = pixel(x, y);
    const auto from = [&](int side, int nx, int ny) {
      if ((beside >> side & 1) == 0 || !is_in(job, nx, ny)) return false;
      const std::uint8_t* there = pixel(nx, ny);
      for (int c = 0; c < 3; ++c)
        if (magnitude(int{here[c]} - int{there[c]}) > most) return true;
      return false;
    };
    return from(0, x - 1, y) || from(1, x + 1, y) || from(2, x, y - 1) || from(3, x, y + 1);
  }

  const Registers& registers_;
  const FrameRegisters& frame_;
  [[no_unique_address]] Faults faults_;
  TileBuffers& buffers_;
  int client_, asked_ = 0, missing_ = 0;
  std::array<TileBytes, 5> around_{};
  Fifo<TileJob>* in_ = nullptr;
  Fifo<LineRequest>* ask_ = nullptr;
  Fifo<TileOrder>* out_ = nullptr;
};

// Adds the samples of a pixel, and makes its bytes.
template <class Faults = NoFaults>
class PixelStage final : public Stage {
 public:
  PixelStage(const Registers& registers, TileBuffers& buffers, Faults faults = {})
      : Stage("pixel"), registers_(registers), faults_(faults), buffers_(buffers) {}
  void connect(Fifo<PressedToken>& in, Fifo<PixelToken>& out) {
    in_ = &in;
    out_ = &out;
  }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    if (!out_->ready()) return Did::blocked;
    const PressedToken& token = *in_->get();
    TileBuffer& buffer = buffers_.at(token.id.buffer);
    const std::size_t at = (token.id.y & (kTileSide - 1)) * kTileSide + (token.id.x & (kTileSide - 1));
    for (std::size_t c = 0; c < 3; ++c) buffer.sums[at][c] += token.pressed[c];
    if (++buffer.counts[at] < buffer.samples) return Did::busy;
    PixelToken& pixel = *out_->put();
    pixel.id = token.id;
    for (std::size_t c = 0; c < 3; ++c) {
      // The mean is full light at most, unless a ray came twice, which a checker tells.
      const int light = std::min((buffer.sums[at][c] + buffer.samples / 2) / buffer.samples,
                                 static_cast<int>(registers_.look.bytes.size()) - 1);
      pixel.bytes[c] = registers_.look.bytes[light];
    }
    faults_.totalled(registers_.look, buffer.sums[at], buffer.samples, pixel);
    for (std::size_t c = 0; c < 3; ++c) buffer.bytes[3 * at + c] = pixel.bytes[c];
    return Did::busy;
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  TileBuffers& buffers_;
  Fifo<PressedToken>* in_ = nullptr;
  Fifo<PixelToken>* out_ = nullptr;
};

// Writes complete tiles to memory.
template <class Faults = NoFaults>
class WriteStage final : public Stage {
 public:
  WriteStage(const FrameRegisters& frame, TileBuffers& buffers, Faults faults = {})
      : Stage("write"), frame_(frame), faults_(faults), buffers_(buffers) {}
  void connect(Fifo<PixelToken>& in, Fifo<LineRequest>& out) {
    in_ = &in;
    out_ = &out;
  }

 private:
  Did cycle() override {
    bool moved = false;
    if (in_->valid()) {
      const PixelToken& pixel = *in_->get();
      TileBuffer& tile_buffer = buffers_.at(pixel.id.buffer);
      const bool at_once = buffers_.complete.empty() && out_->ready();
      if (--tile_buffer.left == 0 || faults_.writes_early(at_once, tile_buffer))
        buffers_.complete.push_back(pixel.id.buffer);
      moved = true;
    }
    if (buffers_.complete.empty()) return moved ? Did::busy : Did::starved;
    if (!out_->ready()) return moved ? Did::busy : Did::memory;
    const int i = buffers_.complete.front();
    const TileBuffer& buffer = buffers_.at(i);
    LineRequest& to = *out_->put();
    to = {0,
          0,
          frame_.address(frame_.write, buffer.job.x / kTileSide, buffer.job.y / kTileSide) + kBurst * burst_,
          kBurst,
          true,
          {}};
    std::memcpy(to.data.data(), buffer.bytes.data() + kBurst * burst_, kBurst);
    faults_.written(frame_, buffer, burst_, to);
    if (++burst_ == kTileBytes / kBurst) {
      burst_ = 0;
      buffers_.complete.pop_front();
      buffers_.free.push_back(i);
    }
    return Did::busy;
  }

  const FrameRegisters& frame_;
  [[no_unique_address]] Faults faults_;
  TileBuffers& buffers_;
  int burst_ = 0;
  Fifo<PixelToken>* in_ = nullptr;
  Fifo<LineRequest>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
