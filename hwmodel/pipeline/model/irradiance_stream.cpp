#include "hwmodel/pipeline/model/irradiance_stream.h"

#include <algorithm>
#include <cstdint>

namespace voxmelt::hwmodel {
namespace {

constexpr std::int64_t kMostDark = 65535;

}  // namespace

IrradianceWords IrradianceStream::words_of(const Irradiance& field, const Shape& shape, int tile) {
  IrradianceWords words;
  std::int64_t dark = 0;
  std::vector<std::uint16_t> lit;
  const auto head = [&](std::uint32_t mask) {
    words.push_back(static_cast<std::uint16_t>(dark));
    for (int i = 0; i < mask_words(shape.lanes); ++i)
      words.push_back(static_cast<std::uint16_t>(mask >> (16 * i)));
    dark = 0;
  };
  for (Place place = begin_of(shape, tile); place.ordinal < shape.tokens(); place.next(shape)) {
    const int lanes = std::min(shape.lanes, shape.grid.x - place.x);
    const std::uint16_t* cells = field.row(place.y, place.z) + place.x;
    std::uint32_t mask = 0;
    lit.clear();
    for (int lane = 0; lane < lanes; ++lane)
      if (cells[lane] != 0) {
        mask |= std::uint32_t{1} << lane;
        lit.push_back(cells[lane]);
      }
    if (mask == 0 && dark < kMostDark) {
      ++dark;
      continue;
    }
    head(mask);
    words.insert(words.end(), lit.begin(), lit.end());
    counts_.lit_cells += lit.size();
    counts_.lit_tokens += lit.empty() ? 0 : 1;
  }
  counts_.bits += words.size() * kWordBits;
  return words;
}

IrradianceStream::IrradianceStream(const Irradiance& field, const Shape& shape) {
  tiles_.reserve(shape.tiles());
  for (int tile = 0; tile < shape.tiles(); ++tile) tiles_.push_back(words_of(field, shape, tile));
}

}  // namespace voxmelt::hwmodel
