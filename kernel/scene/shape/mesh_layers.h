// The winding numbers of the samples are found in one layer after the other. So memory is needed for layers,
// not for the whole box. Some layers are a slab, and are decided band by band. Crossings that follow one
// another lie far apart, and in a whole slab most of the time went into finding their memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/shape/mesh_scan.h"

namespace voxmelt::scene {

class MeshLayers {
 public:
  MeshLayers(const Surface& surface, Inside inside, Coverage& coverage);
  void run();

  // Tells if a sample of a closed mesh is wound around more than once. Then shells overlap, or one crosses
  // itself.
  bool overlaps() const { return most_ > 1; }

 private:
  // Is the samples of layers `first` .. `end` - 1 along the axis s_.
  struct Slab {
    int first, end;
  };
  // Is a range of samples, clipped to the window. A band is a range along q_.
  struct Range {
    int first, end;
  };

  std::int64_t place(int axis, int sample) const { return low_[axis] + sample * kSampleSpacing; }
  Range samples(int axis, std::int64_t first, std::int64_t last) const;
  static Range common(Range a, Range b);
  double sample_of(int axis, double depth) const;
  int sample_at(int axis, double depth) const;

  void total_through_layers();
  void total_in_layers(const Triangle& triangle, Slab slab);
  Range within(const RayCrossings& crossings, Range rays, std::int64_t v, int axis, Range part) const;
  void decide_band(const std::vector<std::uint32_t>& active, Slab slab, Range band);
  void step_through_layers(const Triangle& triangle, Slab slab, Range band);
  void cross_p(const Triangle& triangle, int layer, Range band);
  void cross_q(const Triangle& triangle, int layer, Range band);
  void add_row(int q, int row, int layer);
  void add_closed_row(int q, std::size_t row);
  template <Inside inside>
  void add_open_row(int q, std::size_t row, int layer);
  void store(int layer, Range band);

  const Surface& surface_;
  Inside inside_;
  Coverage& coverage_;
  int s_, p_, q_;                    // axes: across the layers (the longest one), and in them
  std::array<std::int64_t, 3> low_;  // first sample of the window
  std::array<int, 3> count_;         // samples along each axis
  std::size_t width_, height_;       // samples along p and q
  int thickness_;                    // layers in a slab
  int band_;                         // samples in a band, along q

  // Holds, for a band, the crossings of a ray between each sample and the one before it, +1 if it enters,
  // [q][p].
  std::vector<std::int16_t> along_p_, along_q_;
  std::vector<std::uint8_t> touched_;  // rows of along_p_: chunks of samples that are not all 0
  std::size_t chunks_;                 // chunks of a row
  std::vector<std::int8_t> along_s_;   // [layer of the slab][q][p]
  std::vector<std::int16_t> total_p_;  // crossings of whole rays
  // Holds what both rays tell from the present samples. told_q_ has it for each layer of the slab.
  std::vector<std::int16_t> told_p_, told_q_, told_s_;
  std::vector<std::uint16_t> inside_row_;
  std::vector<std::uint8_t> plane_;  // samples inside, in a layer of cells, [q][p]
  int most_ = 0;
};

}  // namespace voxmelt::scene
