#include "kernel/scene/shape/voxelise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

constexpr double kFewCells = 8, kSmallShare = 0.05;
constexpr int kAmountPerSample = rule::kOne / kSamplesPerCell;

// Warns of parts of a mesh that leave no cell. The tips of cones and the edges of wings are none.
void warn_of_thin_parts(const Entry& entry, const EdgeLength& edges, std::vector<std::string>& warnings) {
  const bool inert = entry.role == Role::inert;
  const double vanished = inert ? edges.without_inert : edges.without_solid;
  if (vanished < std::max(kFewCells, kSmallShare * edges.all)) return;
  warnings.push_back(fmt::format(
      "{}: parts thinner than {} a cell vanish, {:.0f} % of its edges; a larger height or scale keeps them",
      entry.mesh_file, inert ? "half" : "a quarter of", 100 * vanished / edges.all));
}

Coverage cover(const Entry& entry, state::Grid grid, std::vector<std::string>& warnings) {
  Coverage coverage;
  if (entry.shape) {
    coverage = scene::cover(*entry.shape, grid);
  } else if (entry.coverage) {
    coverage = *entry.coverage;
  } else {
    MeshCoverage mesh = scene::cover(entry.mesh, entry.inside, grid);
    for (const std::string& finding : mesh.findings)
      warnings.push_back(fmt::format("{}: {}", entry.mesh_file, finding));
    coverage = std::move(mesh.coverage);
    if (!entry.cut) warn_of_thin_parts(entry, mesh.edges, warnings);
  }
  if (std::all_of(coverage.samples.begin(), coverage.samples.end(),
                  [](std::uint8_t samples) { return samples == 0; }))
    warnings.push_back(entry.name + " covers no cell of the grid");
  return coverage;
}

template <class Visit>
void for_each_cell(const Coverage& coverage, const state::Volume& volume, Visit visit) {
  const Window& window = coverage.window;
  std::size_t i = 0;
  for (int z = 0; z < window.size.z; ++z)
    for (int y = 0; y < window.size.y; ++y) {
      const state::Slot row = volume.at(window.x, window.y + y, window.z + z);
      for (int x = 0; x < window.size.x; ++x, ++i)
        if (coverage.samples[i] > 0) visit(row + x, coverage.samples[i]);
    }
}

class Voxeliser {
 public:
  Voxeliser(state::Grid grid, const std::vector<rule::SolidMaterial>& materials)
      : materials_(materials),
        volume_(grid),
        solid_(grid),
        inert_(grid),
        solid_temperature_(grid),
        inert_wall_(grid),
        touched_(row_of(0, grid.z)) {
    if (!materials.empty()) volume_.material = material_ = decltype(material_)(grid);
  }

  void add(const Entry& entry, const Coverage& coverage) {
    const Window& window = coverage.window;
    for (int z = window.z; z < window.z + window.size.z; ++z)
      for (int y = window.y; y < window.y + window.size.y; ++y) touched_[row_of(y, z)] = true;
    for_each_cell(coverage, volume_, [&](state::Slot cell, int samples) {
      if (entry.role == Role::solid && raise(solid_[cell], samples, entry.cut))
        solid_temperature_[cell] = to_temperature(entry.temperature);
      if (entry.role == Role::solid && !entry.cut && !material_.empty() && 2 * samples >= solid_[cell])
        material_[cell] = static_cast<std::uint8_t>(entry.material);
      if (entry.role == Role::inert && raise(inert_[cell], samples, entry.cut))
        write(inert_wall_[cell], entry.wall);
      if (entry.role == Role::liquid) pour(entry, cell, samples);
    });
  }

  state::Volume finish(const Contents& contents) {
    const state::Grid grid = volume_.grid;
    const Terrain& terrain = contents.terrain;
    ground_wall_ = contents.ground_wall;
    std::vector<int> ground(terrain.height.size());
    for (std::size_t c = 0; c < ground.size(); ++c)
      ground[c] = static_cast<int>(std::lround(terrain.height[c]));

    for (int z = 0; z < grid.z; ++z) {
      const std::size_t columns = grid.index(0, z, 0);
      const auto first = ground.begin() + columns;
      const int highest = *std::max_element(first, first + grid.x);
      for (int y = 0; y < grid.y; ++y) {
        if (y >= highest && !touched_[row_of(y, z)]) continue;
        for (int x = 0; x < grid.x; ++x) decide(x, y, z, first[x]);
      }
      for (int x = 0; x < grid.x; ++x) {
        if (first[x] == 0) continue;
        const state::Slot top = volume_.at(x, first[x] - 1, z);
        const double rise = double{terrain.height[columns + x]} - first[x];
        volume_.amount[top] = bed(rise, volume_.heat[top] > 0 ? 1 : 0);
      }
    }
    return std::move(volume_);
  }

 private:
  std::size_t row_of(std::size_t y, std::size_t z) const { return z * volume_.grid.y + y; }

  // Returns the bed offset. It is at least 1 for isothermal walls, since no cell without an amount has heat.
  static rule::Amount bed(double fraction, long least) {
    const long offset = rule::kBedHalf + std::lround(fraction * rule::kOne);
    return static_cast<rule::Amount>(std::clamp<long>(offset, least, rule::kOne - 1));
  }

  // Writes memory only if something changes.
  static void write(rule::Temperature& heat, rule::Temperature value) {
    if (heat != value) heat = value;
  }

  // Raises the coverage of a cell, or cuts it. It returns true if the coverage has grown.
  static bool raise(std::uint8_t& coverage, int samples, bool cut) {
    if (cut) {
      coverage = static_cast<std::uint8_t>(std::max(0, coverage - samples));
      return false;
    }
    if (samples <= coverage) return false;
    coverage = static_cast<std::uint8_t>(samples);
    return true;
  }

  void pour(const Entry& entry, state::Slot cell, int samples) {
    rule::Amount& amount = volume_.amount[cell];
    rule::Energy& energy = volume_.energy[cell];
    if (entry.cut) {
      amount = static_cast<rule::Amount>(amount * (kSamplesPerCell - samples) / kSamplesPerCell);
      energy = std::min(energy, amount);
      return;
    }
    constexpr double kAll = kSamplesPerCell;
    const double covered = samples / kAll;
    const rule::Amount poured = to_amount(entry.amount * covered);
    if (samples < kLeastSolid || poured <= amount) return;
    amount = poured;
    energy = std::min(to_amount(entry.energy * covered), poured);
    volume_.heat[cell] = to_temperature(entry.temperature);
  }

  void decide(int x, int y, int z, int ground) {
    const state::Slot cell = volume_.at(x, y, z);
    rule::Amount& amount = volume_.amount[cell];
    const bool buried = y < ground, shaped = is_shape(x, y, z), inert = buried || shaped;
    const bool solid = !inert && solid_[cell] >= kLeastSolid;
    if (solid) {
      amount = static_cast<rule::Amount>(solid_[cell] * kAmountPerSample);
      volume_.heat[cell] = solid_temperature_[cell];
      if (!material_.empty()) become(cell, material_[cell]);
    }
    const bool liquid = !inert && !solid && amount > 0;
    if (!liquid && volume_.energy[cell] != 0) volume_.energy[cell] = 0;
    if (!liquid && !solid) write(volume_.heat[cell], wall_at(cell, shaped, buried));
    if (inert) amount = bed(buried ? 0 : rise_of_shape(x, y, z, ground), volume_.heat[cell] > 0 ? 1 : 0);
    if (inert) volume_.inert.set(x, y, z, true);
    if (solid) volume_.solid.set(x, y, z, true);
    if (liquid) volume_.liquid.set(x, y, z, true);
  }

  // Makes a solid one of a material, at the temperature that it has as one of the first.
  void become(state::Slot cell, std::uint8_t material) {
    volume_.material[cell] = material;
    const std::int64_t heat = materials_[material].heat_at(volume_.heat[cell]);
    volume_.heat[cell] = static_cast<rule::Temperature>(std::min<std::int64_t>(heat, rule::kTemperatureMax));
  }

  int samples_of_shape(int x, int y, int z) const {
    return y >= 0 && y < volume_.grid.y ? inert_[volume_.at(x, y, z)] : 0;
  }
  bool is_shape(int x, int y, int z) const { return samples_of_shape(x, y, z) >= kLeastInert; }

  // Returns how far the surface of an inert shape lies above the upper face of a cell, in cells. The shape
  // may cover a part of the cell's width alone, as at a rim. That part is what it covers of the cell below,
  // unless the shape is cut there from beneath: then the samples do not say where the surface lies.
  double rise_of_shape(int x, int y, int z, int ground) const {
    if (is_shape(x, y + 1, z)) return 0;
    const bool stands = y == ground;  // on the ground, or on the border
    const int below = stands ? kSamplesPerCell : samples_of_shape(x, y - 1, z);
    if (below < kLeastInert) return 0;
    const bool cut = below < kSamplesPerCell && y - 1 != ground && !is_shape(x, y - 2, z);
    const int covered = samples_of_shape(x, y, z) + samples_of_shape(x, y + 1, z);
    return cut ? 0 : 1.0 * covered / below - 1;
  }

  rule::Temperature wall_at(state::Slot cell, bool shaped, bool ground) const {
    if (shaped && inert_wall_[cell] > 0) return inert_wall_[cell];
    return ground ? ground_wall_ : rule::Temperature{0};
  }

  const std::vector<rule::SolidMaterial>& materials_;
  state::Volume volume_;
  state::Field<std::uint8_t> solid_, inert_;  // samples covered
  state::Field<std::uint8_t> material_;       // of what is solid; empty if there is one
  state::Field<rule::Temperature> solid_temperature_, inert_wall_;
  rule::Temperature ground_wall_ = 0;
  std::vector<bool> touched_;  // rows in which a shape may be
};

}  // namespace

state::Volume voxelise(const Contents& contents, state::Grid grid, std::vector<std::string>& warnings) {
  Voxeliser voxeliser(grid, contents.materials);
  for (const Entry& entry : contents.entries) voxeliser.add(entry, cover(entry, grid, warnings));
  return voxeliser.finish(contents);
}

}  // namespace voxmelt::scene
