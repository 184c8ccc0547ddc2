// A volume holds the light that arrives in every cell of the grid of light (docs/picture/light.md, sections 4
// and 5).
//
// Each sweep keeps its results, as planes of bytes. An update goes only through rows that a change can reach.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/engine/cpu/workers.h"
#include "render/light/light_bytes.h"
#include "render/light/light_loops.h"
#include "render/rule/light_grid.h"

namespace voxmelt::render {

class LightVolume {
 public:
  LightVolume() = default;
  // `to_light` has the length 2^14.
  LightVolume(const LightMatter& matter, picture::Vector to_light, int shift);

  // Takes over the matter that stops and sends light. Only changes since the last call are computed again.
  // The bytes are those of a fresh volume, for any number of threads. Returns whether any byte may have
  // changed.
  bool update(const LightMatter& matter, picture::Vector to_light, int shift, cpu::Workers& workers,
              const LightLoops& loops = light_loops());

  picture::Light operator()(std::int64_t x, std::int64_t y, std::int64_t z) const;
  picture::Vector count() const { return count_; }
  int shift() const { return shift_; }
  const std::vector<LightBytes>& cells() const { return cells_; }

 private:
  static constexpr std::size_t kSides = picture::kSides;
  using Bytes = std::vector<std::uint8_t>;
  // Bounds rows low <= v < high of a slice.
  struct Span {
    int low = 0, high = 0;
    bool any() const { return low < high; }
    void add(int v);
    void add(const Span& other);
  };
  // Holds bytes twice. In natural order rows lie along x, [z][y], and in turned order along y, [x][z].
  struct Plane {
    Bytes natural, turned;
  };
  // Describes how a sweep goes through a plane.
  struct Way {
    bool turned;
    int slices, u, v;  // v: rows of a slice
    std::size_t row, slice_step,
        row_step;  // bytes of a row, to the next slice, to the next row
    bool from_high;
    int at(int slice) const { return from_high ? slices - 1 - slice : slice; }
    std::size_t byte(int slice) const { return at(slice) * slice_step; }
  };
  // Holds the lamp's rays before a slice, and the rows of them that may be darker than 255.
  struct Kept {
    std::vector<std::uint16_t> rays;
    Span dark;
  };
  static constexpr int kKeptEvery = 8;  // slices
  // Holds the room and the results of a sweep. There is one for each side, and one for the lamp.
  struct Sweep {
    std::vector<std::uint16_t> room, rays, losses;
    std::vector<Kept> kept;
    Bytes rows;                      // rows of a slice that changed
    Bytes open, glow;                // rows [z][y] that changed
    Bytes turned_open, turned_glow;  // slices z of turned planes with a change
  };

  void resize(const LightMatter& matter, int shift);
  bool take_over(const LightMatter& matter, const LightLoops& loops);
  bool take_over(const LightPlane& from, Plane& to, const LightLoops& loops);
  Way way(int axis, bool from_high) const;
  void sweep_side(std::size_t side, Plane& plane, const Plane* emission, Bytes& changed,
                  Bytes& turned_changed, Sweep& sweep, const LightLoops& loops) const;
  // The lamp's rays go along an axis, and shift by a slope from slice to slice along the two others, u and v.
  struct LampRays {
    int axis;
    Way way;
    std::int32_t slope_u, slope_v;
    int low_u = 0, low_v = 0, count_u = 0, count_v = 0;  // first rays, and how many there are
    std::size_t row = 0;                                 // numbers from a row of rays to the next
  };
  LampRays lamp_rays() const;
  int begin_lamp(const LampRays& lamp, bool other_lamp, Sweep& sweep, Span& dark) const;
  void note_lamp_rows(const LampRays& lamp, int slice, Sweep& sweep) const;
  void sweep_lamp(Sweep& sweep, bool other_lamp, const LightLoops& loops);
  void turn_back(Plane& plane, const Bytes& slices, Bytes& changed, const LightLoops& loops) const;
  void interleave(cpu::Workers& workers, const LightLoops& loops);

  picture::Vector count_, to_light_;
  int shift_ = 1;
  int x_ = 0, y_ = 0, z_ = 0;  // cells of light
  std::size_t row_ = 0, turned_row_ = 0;
  std::vector<LightBytes> cells_;
  Plane density_, emission_, lamp_;
  std::array<Plane, kSides> open_, glow_;
  std::array<std::vector<Span>, 3> dirty_;  // by axis and slice: rows with changed density or emission
  std::array<Sweep, kSides + 1> sweeps_;
  Bytes nothing_;
};

}  // namespace voxmelt::render
