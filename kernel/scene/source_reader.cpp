#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/scene/look.h"
#include "kernel/scene/parameter_readers.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

constexpr std::uint32_t kForever = 0xFFFFFFFF;
constexpr double kLargestRadius = 8192;
constexpr std::int32_t kMostStepsPerCell = 1024;

rule::Amount read_rate(Reader& reader) {
  return to_amount(reader.number("rate", above(0).at_most(1).because("a full cell per cell and step")));
}

template <class Source>
void read_interval(Reader& reader, Source& source) {
  source.from = reader.integer("from", 0, kForever, 0);
  source.until = reader.integer("until", 0, kForever, kForever);
  if (source.until <= source.from)
    reader.fail("until", fmt::format(" = {} must be after from = {}", source.until, source.from));
}

}  // namespace

rule::Region read_region(Reader& table) {
  const Vec3 at = table.vector<3>("at", coordinate());
  return {to_position(at), to_position(table.number("radius", above(0).at_most(kLargestRadius)))};
}

rule::Temperature read_temperature(Reader& table) {
  return to_temperature(table.number("temperature", fraction(), 0.0));
}

rule::Material read_material(Reader& root) {
  rule::Material material;
  std::optional<Reader> reader = root.table("material");
  if (!reader) return material;
  const double melting_point = reader->number("melting_point", above(0).at_most(1), 0.5);
  const double latent_heat = reader->number("latent_heat", fraction(), 0.0);
  if (exceeds_range(melting_point + latent_heat))
    reader->fail("latent_heat", " and melting_point exceed 1 together: it could never melt");
  material.melting_point = to_temperature(melting_point);
  // Both are rounded apart, so that they might be one unit too high together.
  const int most = rule::kTemperatureMax - material.melting_point;
  material.latent_heat = static_cast<rule::Temperature>(std::min<int>(to_temperature(latent_heat), most));
  if (reader->has("freezing_point")) {
    const double freezing_point = reader->number("freezing_point", above(0).at_most(1));
    if (freezing_point > melting_point)
      reader->fail(
          "freezing_point",
          fmt::format(" = {} is above melting_point = {}: what freezes would still give off latent heat",
                      freezing_point, melting_point));
    material.freezing_point = to_temperature(freezing_point);
  }
  reader->finish();
  return material;
}

rule::Pieces read_pieces(Reader& root) {
  rule::Pieces pieces;
  std::optional<Reader> reader = root.table("pieces");
  if (!reader) return pieces;
  pieces.fall = reader->flag("fall", true);
  pieces.in_liquid = reader->integer("in_liquid", 1, kMostStepsPerCell, 1);
  const double density = reader->number("density", at_least(1.0 / rule::kDensityOne).at_most(1), 1.0);
  pieces.density = std::lround(density * rule::kDensityOne);
  reader->finish();
  return pieces;
}

std::vector<rule::Vent> read_vents(Reader& root) {
  std::vector<rule::Vent> vents;
  for (Reader& reader : root.tables("vent")) {
    rule::Vent vent;
    vent.region = read_region(reader);
    vent.rate = read_rate(reader);
    vent.temperature = read_temperature(reader);
    vent.energy = to_amount(reader.number("energy", fraction(), 1.0));
    read_interval(reader, vent);
    reader.finish();
    vents.push_back(vent);
  }
  return vents;
}

std::vector<rule::Drain> read_drains(Reader& root) {
  std::vector<rule::Drain> drains;
  for (Reader& reader : root.tables("drain")) {
    rule::Drain drain;
    drain.region = read_region(reader);
    drain.rate = read_rate(reader);
    read_interval(reader, drain);
    reader.finish();
    drains.push_back(drain);
  }
  return drains;
}

}  // namespace voxmelt::scene
