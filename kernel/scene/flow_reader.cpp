#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/rule/relax.h"
#include "kernel/scene/parameter_readers.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

constexpr double kLargestKappa = 71;  // mobility fits 36 bits
constexpr std::uint64_t kLargestMobility = (std::uint64_t{1} << 36) - 1;
constexpr double kLargestEntry = 2;  // largest entry of the table of mobilities: 65535 / 32768
constexpr std::uint16_t kMostSubsteps = 1024;
constexpr std::uint16_t kUsualSubsteps = 64;  // at most so many if the scene says nothing
constexpr double kLargestYield = 255;         // x 65536 fits 24 bits

Range amount() { return at_most(kLargestAmount); }

rule::Fall read_fall(Reader& reader) {
  rule::Fall fall;
  const double factor = reader.number("factor", fraction(), 1.0);
  fall.factor = to_factor32(factor);
  fall.wall_factor = to_factor32(reader.number("wall_factor", fraction(), factor));
  fall.minimum = to_amount(reader.number("minimum", amount(), 32.0 / rule::kOne));
  fall.hang = to_amount(reader.number("hang", amount(), 0.0));
  reader.finish();
  return fall;
}

// Reads a table, whose row `pattern` has the directions bit by bit: +x, -x, +z, -z.
void read_table(Reader& reader, rule::PaperLaw& law) {
  if (law.neighbours != 4) reader.fail("table", " needs flow.paper.neighbours = 4");
  if (reader.has("share")) reader.fail("table", " replaces share: give only one of them");
  const std::vector<double> flat = reader.rows("table", 4, 16, 16, fraction());
  law.use_table = true;
  for (std::size_t pattern = 0; pattern < 16; ++pattern) {
    double sum = 0;
    for (std::size_t direction = 0; direction < 4; ++direction) {
      const double factor = flat[4 * pattern + direction];
      if (factor > 0 && (pattern >> direction & 1) == 0)
        reader.fail("table", fmt::format(".{}.{} = {} gives in a direction that is not in pattern {}",
                                         pattern, direction, factor, pattern));
      sum += factor;
      law.table[pattern][direction] =
          static_cast<std::uint16_t>(std::min(65535.0, std::floor(factor * 65536)));
    }
    if (sum > 1 + 1e-9) reader.fail("table", fmt::format(".{} sums to {}, more than 1", pattern, sum));
  }
}

rule::PaperLaw read_paper(Reader& reader) {
  rule::PaperLaw law;
  law.neighbours = reader.integer("neighbours", 4, 8, 8);
  if (law.neighbours != 4 && law.neighbours != 8)
    reader.fail("neighbours", fmt::format(" = {} is not 4 or 8", law.neighbours));
  law.threshold = to_amount(reader.number("threshold", amount(), 0.0));
  if (reader.has("table")) read_table(reader, law);
  const Range share = at_most(1.0 / rule::most_shares(law.neighbours))
                          .because(fmt::format("the bound for {} neighbours", law.neighbours));
  law.share = to_factor16(reader.number("share", share, 0.125));
  law.downhill = reader.flag("downhill", true);
  law.margin = to_amount(reader.number("margin", amount(), 1.0 / 16));
  law.support = reader.flag("support", false);
  law.slump = to_amount(reader.number("slump", amount(), 0.0));
  law.reading = reader.choice("energy", {"text", "printed"}, 0) == 0 ? rule::EnergyReading::text
                                                                     : rule::EnergyReading::printed;
  law.beta = to_factor32(reader.number("beta", at_most(4), 1.0));
  law.alpha_liquid = to_factor16(reader.number("alpha_liquid", fraction(), 1.0));
  law.alpha_solid = to_factor16(reader.number("alpha_solid", fraction(), 1.0));
  law.alpha_floor = to_factor16(reader.number("alpha_floor", fraction(), 1.0));
  law.reheat = to_factor16(reader.number("reheat", fraction(), 0.0));
  reader.finish();
  return law;
}

// Reads a number, or "auto", which gives 0.
std::uint16_t read_substeps(Reader& reader) {
  if (!reader.has("substeps")) return 0;
  if (reader.kind("substeps") != Value::Kind::text) return reader.integer("substeps", 1, kMostSubsteps, 1);
  reader.choice("substeps", {"auto"});
  return 0;
}

rule::ViscousLaw read_viscous(Reader& reader) {
  rule::ViscousLaw law;
  // kq = (2/3) (kappa / 3), with kappa = g dt / nu.
  const double kappa = reader.number("kappa", above(0).at_most(kLargestKappa));
  law.mobility = std::llround(0x1p32 * (2.0 / 9) * kappa);
  law.yield =
      static_cast<std::uint32_t>(std::lround(reader.number("yield", at_most(kLargestYield), 0.0) * 65536));
  law.stiffness = reader.integer<std::uint8_t>("stiffness", 1, 8, 8);
  law.substeps = read_substeps(reader);
  law.substeps_max = reader.integer("substeps_max", 1, kMostSubsteps, kUsualSubsteps);
  law.stages_max = reader.integer<std::uint16_t>("stages_max", 1, rule::kMostStages, 1);
  reader.finish();
  return law;
}

// Mobility doubles every `doubling` of temperature, and is 1 at `reference`.
struct ThermalLaw {
  double reference, doubling;
  double factor(double temperature) const { return std::exp2((temperature - reference) / doubling); }
};

// The viscous law has its mobility at a reference that is as hot as the range of the mobility lets it be. So
// what is colder is a part of it, and keeps all its digits.
void read_thermal_viscous(const ThermalLaw& law, rule::Flow& flow, std::vector<std::string>& warnings) {
  const double room =
      std::log2(static_cast<double>(kLargestMobility) / static_cast<double>(flow.viscous.mobility));
  const double hottest = std::min(1.0, law.reference + law.doubling * std::max(0.0, room));
  flow.mobility_reference = static_cast<std::uint16_t>(std::floor(65535 * hottest));
  flow.mobility_rate = static_cast<std::uint16_t>(std::lround(64 * (65536.0 / 65535) / law.doubling));
  const double unit = law.factor(flow.mobility_reference / 65535.0);
  flow.viscous.mobility = std::llround(static_cast<double>(flow.viscous.mobility) * unit);
  const double most = 256 * unit;  // rule::warmed has eight octaves above its reference
  if (law.factor(1) > most)
    warnings.push_back(
        fmt::format("flow.thermal: the mobility wants to be {:.3g} times that at the reference, and stops at "
                    "{:.3g} times, "
                    "from temperature {:.3g} on",
                    law.factor(1), most, law.reference + law.doubling * std::log2(most)));
}

// The paper's law has a table of 32 mobilities over the range of temperatures. An entry is at most twice its
// unit. If the hottest liquid wants more, the unit stands for 2, 4, ... times that mobility. The rule itself
// cuts twice the paper's largest share, so no more is wanted.
void read_thermal_paper(const ThermalLaw& law, rule::Flow& flow, std::vector<std::string>& warnings) {
  const auto entries = flow.mobility_table.size();
  const double band = 1 / static_cast<double>(entries);
  const auto factor = [&](std::size_t i) { return law.factor((static_cast<double>(i) + 0.5) * band); };
  double unit = 1;
  while (factor(entries - 1) > kLargestEntry * unit &&
         flow.paper.share <= rule::largest_share(flow.paper.neighbours) / 2) {
    flow.paper.share = static_cast<std::uint16_t>(2 * flow.paper.share);
    unit *= 2;
  }
  for (std::size_t i = 0; i < entries; ++i)
    flow.mobility_table[i] =
        static_cast<std::uint16_t>(std::lround(std::min(65535.0, 32768 * factor(i) / unit)));
  if (law.doubling < band)
    warnings.push_back(
        fmt::format("flow.thermal: the paper's law has 32 mobilities over the range of temperatures, and "
                    "with doubling = {} "
                    "each is {:.3g} times the one before; law = \"viscous\" has no steps",
                    law.doubling, std::exp2(band / law.doubling)));
}

void read_thermal(Reader& reader, rule::Flow& flow, std::vector<std::string>& warnings) {
  const double reference = reader.number("reference", fraction());
  const ThermalLaw law{reference, reader.number("doubling", at_least(0.002).at_most(1))};
  flow.thermal_viscosity = true;
  if (flow.law == rule::Law::viscous)
    read_thermal_viscous(law, flow, warnings);
  else
    read_thermal_paper(law, flow, warnings);
  reader.finish();
}

}  // namespace

rule::Flow read_flow(Reader& root, std::vector<std::string>& warnings) {
  rule::Flow flow;
  std::optional<Reader> reader = root.table("flow");
  if (!reader) return flow;
  const std::vector<std::string> laws{"paper", "viscous"};
  const std::size_t law = reader->choice("law", laws, 0);
  flow.law = law == 0 ? rule::Law::paper : rule::Law::viscous;
  const std::string& other = laws[1 - law];
  if (reader->has(other))
    fail_at(reader->place(other), fmt::format("flow.{} is not used by law = \"{}\"", other, laws[law]));

  if (std::optional<Reader> fall = reader->table("fall")) flow.fall = read_fall(*fall);
  std::optional<Reader> own = reader->table(laws[law]);
  if (own && law == 0) flow.paper = read_paper(*own);
  if (own && law == 1) flow.viscous = read_viscous(*own);
  if (!own && law == 1) reader->fail("viscous", " is missing: the law needs its kappa");
  if (std::optional<Reader> thermal = reader->table("thermal")) read_thermal(*thermal, flow, warnings);
  reader->finish();
  return flow;
}

}  // namespace voxmelt::scene
