#include "render/density/tones.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <tuple>

namespace voxmelt::render {
namespace {

Tint in_integers(const scene::Vec3& color) {
  const auto light = [](double value) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(value, 12)));
  };
  return {light(color[0]), light(color[1]), light(color[2])};
}

// Colours that differ as much need an order, too.
auto order_of(const Tint& tint, const Tint& first) {
  const std::int32_t differs =
      2 * std::abs(tint[0] - first[0]) + 7 * std::abs(tint[1] - first[1]) + std::abs(tint[2] - first[2]);
  return std::tuple(differs, tint);
}

}  // namespace

std::vector<Tint> tints_of(const scene::Look& look) {
  if (look.glow || look.materials.empty()) return {};  // a glowing field holds heat
  std::vector<Tint> tints;
  for (const scene::Vec3& color : look.materials) tints.push_back(in_integers(color));
  const Tint first = tints[0];
  std::ranges::sort(tints, {}, [&](const Tint& tint) { return order_of(tint, first); });
  const auto rest = std::ranges::unique(tints);
  tints.erase(rest.begin(), rest.end());
  if (tints.size() < 2) return {};
  std::vector<Tint> line;
  for (std::size_t i = (tints.size() - 1) / 2; i > 0; --i) line.push_back(tints[2 * i]);
  line.push_back(first);
  for (std::size_t i = 1; i < tints.size(); i += 2) line.push_back(tints[i]);
  return line;
}

std::optional<Tones> tones_of(const scene::Look& look) {
  const std::vector<Tint> tints = tints_of(look);
  if (tints.empty()) return std::nullopt;
  Tones tones{};
  for (std::size_t m = 0; m < std::min(look.materials.size(), tones.size()); ++m) {
    const auto place = std::ranges::find(tints, in_integers(look.materials[m])) - tints.begin();
    tones[m] = static_cast<std::uint8_t>(255 * place / static_cast<std::ptrdiff_t>(tints.size() - 1));
  }
  return tones;
}

}  // namespace voxmelt::render
