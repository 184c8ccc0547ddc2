// The field and the ground give the matter that stops and sends light (docs/picture/light.md, section 4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/density/density_field.h"
#include "render/light/light_bytes.h"
#include "render/light/light_loops.h"
#include "render/rule/look.h"

namespace voxmelt::render {

class LightSources {
 public:
  // Takes over a field and its ground, and returns whether any byte has changed. `ground` is the height of
  // each column in 1/4096 cells, [z][x], and empty if there is none. `refreshed` lists the bricks that were
  // filtered again since the last call, or is null for all. Another grid or look is read anew.
  bool update(const DensityField& field, const std::vector<std::int32_t>& ground, const picture::Look& look,
              const std::vector<std::uint32_t>* refreshed, const LightLoops& loops = light_loops());

  const LightMatter& matter() const { return matter_; }

 private:
  using Emission = std::array<std::uint16_t, 257>;

  void find_blocks(const DensityField& field, const std::vector<std::uint32_t>* refreshed);
  bool refresh_block(const DensityField& field, std::uint32_t block, const LightLoops& loops);
  bool refresh_ground(const std::vector<std::int32_t>& ground);
  bool refresh_earth(std::int64_t x, std::int64_t z, const std::vector<std::int32_t>& ground);
  bool show(std::size_t cell);
  std::uint8_t thinned_density(std::uint8_t all, std::uint8_t obstacle) const;

  state::Grid grid_{0, 0, 0}, blocks_{0, 0, 0};  // blocks are bricks, or cells of light if larger
  int shift_ = 1;
  bool glow_ = false, clear_ = false;
  std::array<std::uint8_t, 256> thinned_{};  // densities of clear matter
  Emission emission_of_{};                   // (heat heat) >> 8, by temperature
  LightMatter matter_;
  std::vector<std::uint8_t> own_, earth_;  // the two parts of the density
  std::vector<std::int32_t> ground_;
  std::vector<std::uint32_t> list_;
  std::vector<std::uint8_t> listed_;
};

inline LightMatter light_matter(const DensityField& field, const std::vector<std::int32_t>& ground,
                                const picture::Look& look) {
  LightSources sources;
  sources.update(field, ground, look, nullptr);
  return sources.matter();
}

}  // namespace voxmelt::render
