#include "accuracy/picture/exact_shade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace voxmelt::accuracy {
namespace {

constexpr double kOne = picture::kLight;

Exact color_of(const picture::Color& c) { return exact({c[0], c[1], c[2]}, kOne); }
Exact times(Exact a, Exact b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Exact mix(Exact a, Exact b, double share) { return a + (b - a) * share; }

double smooth(double low, double high, double v) {
  const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Weighs six values, each up to 255, as seen along a direction. The result is at most 1.
double seen(const std::array<double, 6>& sides, Exact d) {
  const double sum = d.x * d.x * sides[d.x < 0 ? 1 : 0] + d.y * d.y * sides[d.y < 0 ? 3 : 2] +
                     d.z * d.z * sides[d.z < 0 ? 5 : 4];
  return std::min(sum / 255, 1.0);
}

double highlight(const picture::Highlight& table, double cosine) {
  const double at = cosine * 1024;
  const auto i = static_cast<std::size_t>(at);
  return blend(table[i], table[i + 1], at - static_cast<double>(i)) / kOne;
}

struct Material {
  Exact diffuse, mirror, highlight;
  double gloss;
};
Material material_of(const picture::Material& m) {
  return {color_of(m.diffuse), color_of(m.mirror), color_of(m.highlight), m.gloss / kOne};
}
Material mix(const Material& a, const Material& b, double share) {
  return {mix(a.diffuse, b.diffuse, share), mix(a.mirror, b.mirror, share),
          mix(a.highlight, b.highlight, share), blend(a.gloss, b.gloss, share)};
}

}  // namespace

ExactShade::ExactShade(const render::PictureScene& scene) : light_(scene.light), paint_(scene.paint) {
  if (paint_.clear) throw std::invalid_argument("no picture in double: the look has clear matter");
}

ExactShade::Light ExactShade::light_before(Exact p, Exact normal) const {
  const double side = 1 << light_.shift();
  const Exact q = (p + normal * side) * (1 / side);
  struct Axis {
    std::int64_t low, high;
    double part;
  };
  const auto axis = [](double at, std::int64_t count) {
    const double floor = std::floor(at - 0.5);
    const auto within = [&](double i) {
      return static_cast<std::int64_t>(std::clamp(i, 0.0, static_cast<double>(count - 1)));
    };
    return Axis{within(floor), within(floor + 1), at - 0.5 - floor};
  };
  const picture::Vector n = light_.count();
  const Axis x = axis(q.x, n.x), y = axis(q.y, n.y), z = axis(q.z, n.z);
  Light light;
  for (int corner = 0; corner < 8; ++corner) {
    const bool i = (corner & 1) != 0, j = (corner & 2) != 0, k = (corner & 4) != 0;
    const double weight = (i ? x.part : 1 - x.part) * (j ? y.part : 1 - y.part) * (k ? z.part : 1 - z.part);
    const picture::Light cell = light_(i ? x.high : x.low, j ? y.high : y.low, k ? z.high : z.low);
    light.lamp += weight * cell.lamp;
    for (std::size_t s = 0; s < 6; ++s) {
      light.open[s] += weight * cell.open[s];
      light.glow[s] += weight * cell.glow[s];
    }
  }
  return light;
}

Exact ExactShade::arriving(Exact normal, const Light& light, bool lit_by_glow) const {
  const Exact to_light = unit(exact(paint_.to_light, 1));
  const double lit = std::max(dot(normal, to_light) + 0.15, 0.0) / 1.15 * light.lamp / 255;
  const Exact ambient = mix(color_of(paint_.from_below), color_of(paint_.from_above), (normal.y + 1) / 2);
  Exact sum = ambient * seen(light.open, normal) + color_of(paint_.lamp) * lit;
  if (lit_by_glow) sum = sum + color_of(picture::kGlowLight) * (seen(light.glow, normal) * 255 / 32);
  return sum;
}

Exact ExactShade::mirrored(Exact r) const {
  const auto entry = [&](std::size_t i) {
    const std::uint32_t packed = paint_.surroundings[i];
    return exact({(packed & 2047) << 1, ((packed >> 11) & 2047) << 1, (packed >> 22) << 2}, kOne);
  };
  const double at = std::clamp(r.y + 1, 0.0, 2.0) * 1024;
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(at), 2047);
  const double lamp =
      smooth(paint_.lamp_low / kOne, paint_.lamp_high / kOne, dot(r, unit(exact(paint_.to_light, 1))));
  const double strip =
      smooth(paint_.strip_low / kOne, picture::kStripHigh / kOne, dot(r, unit(exact(paint_.to_strip, 1))));
  return mix(entry(i), entry(i + 1), at - static_cast<double>(i)) + color_of(picture::kMirroredLamp) * lamp +
         color_of(picture::kMirroredStrip) * strip;
}

Exact ExactShade::matter_color(Exact p, Exact normal, Exact to_eye, const ExactField::Matter& matter) const {
  const double liquid = matter.liquid / 255,
               obstacle = std::clamp((matter.obstacle - 148) * 73 / kOne, 0.0, 1.0);
  Material material = mix(material_of(paint_.solid), material_of(paint_.liquid), liquid);
  Exact emission;
  if (paint_.glow) {
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(matter.heat), 254);
    const double part = matter.heat - static_cast<double>(i);
    const auto at = [&](const auto& table) {
      return mix(color_of(table[i]), color_of(table[i + 1]), part) * liquid;
    };
    material.diffuse = material.diffuse + at(paint_.glow_colors.crust);
    emission = at(paint_.glow_colors.light) * (1 - obstacle);
  }
  material = mix(material, material_of(paint_.obstacle), obstacle);

  const Light light = light_before(p, normal);
  const Exact to_light = unit(exact(paint_.to_light, 1));
  const double shine = std::clamp(dot(normal, unit(to_light + to_eye)), 0.0, 1.0);
  double peak = blend(highlight(paint_.highlight, shine), highlight(paint_.dull_highlight, shine), obstacle);
  peak *= smooth(0, 0.25, dot(normal, to_light)) * light.lamp / 255;

  const double eye = std::clamp(dot(normal, to_eye), 0.0, 1.0), more = std::pow(1 - eye, 5) * material.gloss;
  const Exact reflected = normal * (2 * dot(normal, to_eye)) - to_eye;
  const double free = 614 / kOne + 3482 / kOne * seen(light.open, reflected) * seen(light.open, normal);
  const Exact fresnel = mix(material.mirror, {1, 1, 1}, more);

  return times(arriving(normal, light, paint_.glow && obstacle > 0), material.diffuse) +
         material.highlight * peak + times(mirrored(reflected) * free, fresnel) +
         emission * ((2540 + 1556 * eye) / kOne);
}

Exact ExactShade::ground_color(Exact p, Exact normal, Exact color) const {
  return times(arriving(normal, light_before(p, normal), paint_.glow), color);
}

Exact pressed(Exact light) {
  const auto press = [](double c) {
    c = std::clamp(c, 0.0, 3.0);
    return c <= 0.7 ? c : 0.7 + 0.3 * (1 - std::exp((0.7 - c) / 0.3));
  };
  return {press(light.x), press(light.y), press(light.z)};
}

render::Rgb bytes_of(Exact light) {
  const auto byte = [](double c) {
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0, 1.0)));
  };
  return {byte(light.x), byte(light.y), byte(light.z)};
}

}  // namespace voxmelt::accuracy
