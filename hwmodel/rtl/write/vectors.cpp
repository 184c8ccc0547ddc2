#include "hwmodel/rtl/write/vectors.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/cell.h"

namespace voxmelt::hwmodel {
namespace {

// Writes one number, bit by bit from the lowest.
class Line {
 public:
  explicit Line(std::size_t bits) : digits_((bits + 3) / 4, 0) {}
  void put(std::uint64_t value, int bits) {
    for (int i = 0; i < bits; ++i, ++at_)
      digits_[at_ / 4] = static_cast<unsigned char>(digits_[at_ / 4] | (value >> i & 1) << (at_ % 4));
  }
  std::string text() const {
    std::string text;
    for (auto digit = digits_.rbegin(); digit != digits_.rend(); ++digit) text += "0123456789abcdef"[*digit];
    return text + '\n';
  }

 private:
  std::vector<unsigned char> digits_;
  std::size_t at_ = 0;
};

// Calls put(line, x, y, z, inside) for every lane of every token, and returns the lines.
template <class Put>
std::string lines_of(const Shape& shape, int bits, Put&& put) {
  std::string text;
  Place place = begin_of(shape, 0);
  for (std::int64_t i = 0; i < shape.tokens(); ++i, place.next(shape)) {
    Line line(static_cast<std::size_t>(bits) * static_cast<std::size_t>(shape.lanes));
    for (int x = place.x; x < place.x + shape.lanes; ++x) put(line, x, place.y, place.z, x < shape.grid.x);
    text += line.text();
  }
  return text;
}

std::uint64_t stored_word(const state::Volume& volume, int x, int y, int z) {
  const state::Slot at = volume.at(x, y, z);
  const State state = volume.inert.test(x, y, z)    ? State::inert
                      : volume.solid.test(x, y, z)  ? State::solid
                      : volume.liquid.test(x, y, z) ? State::liquid
                                                    : State::air;
  const std::uint16_t energy =
      state == State::solid && !volume.material.empty() ? volume.material[at] : volume.energy[at];
  return static_cast<std::uint64_t>(state) | std::uint64_t{volume.amount[at]} << 2 |
         std::uint64_t{energy} << 18 | std::uint64_t{volume.heat[at]} << 34;
}

}  // namespace

std::string cell_lines(const state::Volume& volume, const Shape& shape, int bits) {
  const std::uint64_t border = static_cast<std::uint64_t>(State::inert) | std::uint64_t{kFlatBed} << 2;
  return lines_of(shape, bits, [&](Line& line, int x, int y, int z, bool inside) {
    line.put(inside ? stored_word(volume, x, y, z) : border, bits);
  });
}

std::string irradiance_lines(const Irradiance* irradiance, const Shape& shape) {
  const state::Volume slots(shape.grid);
  return lines_of(shape, 16, [&](Line& line, int x, int y, int z, bool inside) {
    line.put(inside && irradiance != nullptr ? (*irradiance)[slots.at(x, y, z)] : 0, 16);
  });
}

std::string fall_lines(const state::BitPlane* falling, const Shape& shape) {
  return lines_of(shape, 1, [&](Line& line, int x, int y, int z, bool inside) {
    line.put(inside && falling != nullptr && falling->test(x, y, z) ? 1 : 0, 1);
  });
}

}  // namespace voxmelt::hwmodel
