#include "kernel/scene/volume_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/scene/look.h"
#include "kernel/scene/shape/coverage.h"
#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/stand.h"
#include "kernel/scene/text/units.h"
#include "kernel/scene/voxel_file/voxels.h"

namespace voxmelt::scene {
namespace {

constexpr double kLargestNumber = 1e15, kMostVoxels = 4096;
constexpr std::int64_t kMostSkipped = std::int64_t{1} << 30;
constexpr int kSamples = kSamplesPerAxis;

// Turns what points along z in the file up, and what faced -y to the front.
void turn_up(Voxels& voxels) {
  const auto [nx, ny, nz] = voxels.size;
  std::vector<std::uint8_t> turned;
  turned.reserve(voxels.filled.size());
  for (int z = 0; z < ny; ++z)
    for (int y = 0; y < nz; ++y) {
      const auto row =
          voxels.filled.begin() + static_cast<std::ptrdiff_t>(nx) * (ny - 1 - z + ny * std::ptrdiff_t{y});
      turned.insert(turned.end(), row, row + nx);
    }
  voxels.filled = std::move(turned);
  std::swap(voxels.size[1], voxels.size[2]);
  std::swap(voxels.spacing[1], voxels.spacing[2]);
}

// Returns the box of the filled voxels in the unit of the file. It fails if there are none.
Box box_of(const Voxels& voxels, const VoxelSource& source) {
  const auto [nx, ny, nz] = voxels.size;
  std::array<int, 3> low = voxels.size, high{};
  std::size_t i = 0;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x, ++i) {
        if (voxels.filled[i] == 0) continue;
        const std::array at{x, y, z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at[axis]);
          high[axis] = std::max(high[axis], at[axis] + 1);
        }
      }
  if (high[0] == 0) source.fail("no number is within `filled`, so no voxel is");
  const auto& s = voxels.spacing;
  return {{low[0] * s[0], low[1] * s[1], low[2] * s[2]}, {high[0] * s[0], high[1] * s[1], high[2] * s[2]}};
}

// An axis of the grid: its first cell with a sample in the volume, and of each sample from there on the
// voxel.
struct Axis {
  int first = 0, cells = 0;
  std::vector<int> voxel;  // or -1 outside
};

Axis axis_of(int cells, int voxels, double origin, double side) {
  Axis axis;
  std::vector<int> all;
  int last = -1;
  axis.first = cells;
  for (int s = 0; s < kSamples * cells; ++s) {
    const double at = std::floor(((s + 0.5) / kSamples - origin) / side);
    const bool is_within = at >= 0 && at < voxels;
    all.push_back(is_within ? static_cast<int>(at) : -1);
    if (!is_within) continue;
    axis.first = std::min(axis.first, s / kSamples);
    last = s / kSamples;
  }
  axis.cells = std::max(0, last + 1 - axis.first);
  if (axis.cells > 0)
    axis.voxel.assign(all.begin() + kSamples * axis.first, all.begin() + kSamples * (last + 1));
  return axis;
}

// Counts the samples of each cell that lie in filled voxels. `at` is where the corner of the first voxel
// lies.
Coverage cover(const Voxels& voxels, Point at, double scale, state::Grid grid) {
  const auto& [nx, ny, nz] = voxels.size;
  const std::array side{voxels.spacing[0] * scale, voxels.spacing[1] * scale, voxels.spacing[2] * scale};
  const Axis along_x = axis_of(grid.x, nx, at.x, side[0]), along_y = axis_of(grid.y, ny, at.y, side[1]),
             along_z = axis_of(grid.z, nz, at.z, side[2]);
  Coverage coverage;
  if (along_x.cells == 0 || along_y.cells == 0 || along_z.cells == 0) return coverage;
  coverage.window = {
      along_x.first, along_y.first, along_z.first, {along_x.cells, along_y.cells, along_z.cells}};
  coverage.samples.resize(coverage.window.size.cells());
  for (std::size_t sz = 0; sz < along_z.voxel.size(); ++sz)
    for (std::size_t sy = 0; sy < along_y.voxel.size(); ++sy) {
      if (along_z.voxel[sz] < 0 || along_y.voxel[sy] < 0) continue;
      const std::uint8_t* row =
          voxels.filled.data() + (std::size_t{1} * along_z.voxel[sz] * ny + along_y.voxel[sy]) * nx;
      std::uint8_t* cells =
          coverage.samples.data() + (sz / kSamples * along_y.cells + sy / kSamples) * along_x.cells;
      for (std::size_t sx = 0; sx < along_x.voxel.size(); ++sx)
        if (along_x.voxel[sx] >= 0 && row[along_x.voxel[sx]] != 0) ++cells[sx / kSamples];
    }
  return coverage;
}

// Reads which numbers fill a voxel.
Filled read_filled(Reader& reader) {
  const bool is_default = !reader.has("filled");
  const auto [low, high] =
      reader.vector<2>("filled", within(kLargestNumber), std::array{0.5, kLargestNumber});
  if (low > high) reader.fail("filled", fmt::format(" = [{}, {}] is no range", low, high));
  return {low, high, is_default};
}

// Reads what a header would say, of a file that has none.
std::optional<RawNumbers> read_raw_header(Reader& reader) {
  std::optional<Reader> header = reader.table("raw");
  if (!header) return std::nullopt;
  RawNumbers raw;
  const std::array<double, 3> size = header->vector<3>("size", within(kMostVoxels));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size[axis] < 1 || size[axis] != std::floor(size[axis]))
      header->fail("size", fmt::format(": {} is no number of voxels", size[axis]));
    raw.size[axis] = static_cast<std::uint64_t>(size[axis]);
  }
  raw.type = header->choice("type", {kNumberTypes.begin(), kNumberTypes.end()});
  raw.is_big_endian = header->choice("endian", {"little", "big"}, 0) == 1;
  raw.skip = header->integer("skip", 0, kMostSkipped, 0);
  raw.spacing = header->vector<3>("spacing", above(0).at_most(kLargestScale), std::array{1.0, 1.0, 1.0});
  header->finish();
  return raw;
}

}  // namespace

void read_volume_entry(Reader& reader, state::Grid grid, Entry& entry, std::vector<std::string>& warnings) {
  VoxelSource source;
  source.file = reader.file("file");
  source.place = reader.place("file");
  if (reader.has("array") && reader.has("part")) reader.fail("part", " and array exclude each other");
  for (const char* const key : {"array", "part"})
    if (reader.has(key)) source.array = reader.text(key);
  source.is_filled = read_filled(reader);
  source.raw = read_raw_header(reader);
  const bool z_is_up = reader.choice("up", {"y", "z"}, 0) == 1;
  Voxels voxels = read_voxels(source);
  if (!voxels.note.empty()) warnings.push_back(voxels.note);
  if (z_is_up) turn_up(voxels);
  const Box box = box_of(voxels, source);
  const double metre = read_unit(reader);
  if (const std::optional<Stand> fit = read_fit(reader, source.file, box, grid)) {
    const Point foot{(box.low.x + box.high.x) / 2, box.low.y, (box.low.z + box.high.z) / 2};
    entry.coverage = cover(voxels, fit->at - foot * fit->scale, fit->scale, grid);
    return;
  }
  const double scale = reader.number("scale", above(0).at_most(kLargestScale), 1.0) * metre;
  const Point at = to_point(reader.vector<3>("at", coordinate(), Vec3{}));
  entry.coverage = cover(voxels, at, scale, grid);
}

Point size_of_volume(const std::filesystem::path& file, const Place& place) {
  const VoxelSource source{file, place, {}};
  const Box box = box_of(read_voxels(source), source);
  return box.high - box.low;
}

}  // namespace voxmelt::scene
