// The reader of MagicaVoxel's .vox. A voxel's number is its index in the palette, from 1 on; 0 is empty. Its
// z points up, and here y does.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernel/scene/text/bytes.h"
#include "kernel/scene/voxel_file/formats.h"
#include "kernel/scene/voxel_file/magica_scene.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kHeader = 8, kChunk = 12;  // bytes
constexpr std::uint32_t kLargestModel = 256;     // voxels along a side
constexpr std::int64_t kLargestScene = 4096;
constexpr std::size_t kMostVoxels = std::size_t{1} << 28;  // that are placed, of all models together

struct Model {
  std::array<std::uint32_t, 3> size{};
  std::string_view voxels;  // x, y, z and index of each, a byte each

  std::size_t count() const { return voxels.size() / 4; }
  std::uint8_t part(std::size_t voxel, std::size_t k) const {
    return number_at<std::uint8_t>(voxels.substr(4 * voxel + k));
  }
};

void read_size(std::string_view content, std::vector<Model>& models, const VoxelSource& source) {
  if (content.size() < 12) source.fail("its size is truncated");
  Model& model = models.emplace_back();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto side = number_at<std::uint32_t>(content.substr(4 * axis));
    if (side < 1 || side > kLargestModel)
      source.fail(fmt::format("a side of {} voxels; 1 to {} are read", side, kLargestModel));
    model.size[axis] = side;
  }
}

void read_voxels_of(std::string_view content, std::vector<Model>& models, const VoxelSource& source) {
  if (models.empty()) source.fail("its voxels come before its size");
  Model& model = models.back();
  const std::size_t count = content.size() < 4 ? 0 : number_at<std::uint32_t>(content);
  if (content.size() < 4 || count != (content.size() - 4) / 4)
    source.fail(fmt::format("{} voxels are not {} bytes", count, content.size()));
  model.voxels = content.substr(4, 4 * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (model.part(i, axis) >= model.size[axis])
        source.fail(fmt::format("voxel {} is at {}, {}, {}, outside of the model", i, model.part(i, 0),
                                model.part(i, 1), model.part(i, 2)));
}

// The cell of a voxel: its middle, turned about the middle of the model, in halves of a voxel. Where a side
// is odd, the middle is the lower corner of the middle voxel.
Place3 cell_of(const Model& model, const Turn& turn, const Place3& voxel) {
  Place3 middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = 2 * (voxel[axis] - model.size[axis] / 2) + 1;
  Place3 cell = turn.of(middle);
  for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] = (cell[axis] - 1) / 2 + turn.move[axis];
  return cell;
}

struct Extent {
  Place3 low{}, high{};  // the cells at both ends
};

Extent extent_of(const std::vector<Model>& models, const std::vector<PlacedModel>& placed) {
  Extent all;
  bool is_first = true;
  for (const PlacedModel& one : placed) {
    const Model& model = models[one.model];
    for (const Place3& corner :
         {cell_of(model, one.turn, {}),
          cell_of(model, one.turn, {model.size[0] - 1, model.size[1] - 1, model.size[2] - 1})}) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        all.low[axis] = is_first ? corner[axis] : std::min(all.low[axis], corner[axis]);
        all.high[axis] = is_first ? corner[axis] : std::max(all.high[axis], corner[axis]);
      }
      is_first = false;
    }
  }
  return all;
}

Voxels joined(const std::vector<Model>& models, const std::vector<PlacedModel>& placed,
              const VoxelSource& source) {
  const Extent all = extent_of(models, placed);
  std::size_t cells = 1, voxels_placed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t side = all.high[axis] - all.low[axis] + 1;
    if (side > kLargestScene)
      source.fail(fmt::format("its models span {} voxels; at most {} are read", side, kLargestScene));
    cells *= static_cast<std::size_t>(side);
  }
  for (const PlacedModel& one : placed) voxels_placed += models[one.model].count();
  if (cells > kLargestVoxelFile || voxels_placed > kMostVoxels)
    source.fail(fmt::format("its models are too large: {} voxels within {}", voxels_placed, cells));

  Voxels voxels;
  voxels.size = {static_cast<int>(all.high[0] - all.low[0] + 1),
                 static_cast<int>(all.high[2] - all.low[2] + 1),
                 static_cast<int>(all.high[1] - all.low[1] + 1)};
  voxels.filled.assign(cells, source.is_filled(0) ? 1 : 0);
  const std::size_t nx = voxels.size[0], ny = voxels.size[1];
  for (const PlacedModel& one : placed) {
    const Model& model = models[one.model];
    for (std::size_t i = 0; i < model.count(); ++i) {
      const Place3 cell = cell_of(model, one.turn, {model.part(i, 0), model.part(i, 1), model.part(i, 2)});
      const std::size_t x = cell[0] - all.low[0], y = cell[2] - all.low[2], z = all.high[1] - cell[1];
      voxels.filled[x + nx * (y + ny * z)] = source.is_filled(model.part(i, 3)) ? 1 : 0;
    }
  }
  return voxels;
}

}  // namespace

Voxels read_magica_voxels(std::string_view bytes, const VoxelSource& source) {
  if (!bytes.starts_with("VOX ") || bytes.size() < kHeader + kChunk) source.fail("no file of MagicaVoxel");
  std::vector<Model> models;
  MagicaScene scene(source);
  for (std::size_t at = kHeader; at < bytes.size();) {
    if (bytes.size() - at < kChunk) source.fail("a chunk is truncated");
    const std::string_view name = bytes.substr(at, 4);
    const std::size_t size = number_at<std::uint32_t>(bytes.substr(at + 4));
    at += kChunk;
    if (size > bytes.size() - at) source.fail("a chunk is truncated");
    const std::string_view content = bytes.substr(at, size);
    at += size;  // chunks within MAIN follow it
    if (name == "SIZE") read_size(content, models, source);
    if (name == "XYZI") read_voxels_of(content, models, source);
    scene.read(name, content);
  }
  if (models.empty()) source.fail("it has no model");
  // Files of old programs have no scene.
  if (!scene.is_there() && models.size() > 1)
    source.fail(fmt::format("it has {} models, and no scene that places them", models.size()));
  const std::vector<PlacedModel> placed =
      scene.is_there() ? scene.models(models.size()) : std::vector<PlacedModel>{{}};
  if (placed.empty()) source.fail("its scene shows no model: all is hidden");
  return joined(models, placed, source);
}

}  // namespace voxmelt::scene
