#include "render/device/device_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/engine/gpu/constants.h"
#include "render/density/columns.h"
#include "render/density/low_pass.h"
#include "render/density/tones.h"

namespace voxmelt::render {
namespace {

constexpr int kRim = kMaxPasses;                                   // as in program/lattice.cl
constexpr int kColumnKinds = 9, kFilm = 0, kBed = 1, kOffset = 2;  // as in program/columns.cl
constexpr int kHeatChannel = 4;
enum Shows : std::int32_t { kNoHeat, kShowsHeat, kShowsTones };  // as in program/matter.cl

std::int64_t places_of(const state::Grid& grid) {
  return (std::int64_t{grid.x} + 2 * kRim) * (std::int64_t{grid.y} + 2 * kRim) *
         (std::int64_t{grid.z} + 2 * kRim);
}

// The terrain's heights in whole cells, or none if it does not fit.
std::vector<std::int32_t> heights_of(const scene::Terrain& terrain, const state::Grid& grid) {
  std::vector<std::int32_t> heights;
  if (!fits(terrain, grid)) return heights;
  for (const float height : terrain.height)
    heights.push_back(
        static_cast<std::int32_t>(std::clamp<long>(std::lround(height), 0, static_cast<long>(grid.y))));
  return heights;
}

}  // namespace

std::size_t DeviceField::places() const { return static_cast<std::size_t>(places_of(grid_)); }

void DeviceField::resize(const gpu::StateOnDevice& state, int channels) {
  const state::Grid& grid = state.shape->grid;
  if (grid == grid_ && channels == channels_) return;
  grid_ = {0, 0, 0};
  for (Buffer* buffer : {&now_, &next_, &as_solid_, &as_liquid_, &columns_, &levels_, &next_levels_})
    buffer->reset();
  if (places_of(grid) > std::numeric_limits<std::int32_t>::max())
    throw gpu::DeviceError("the grid is too large for a picture on the device");
  const std::size_t field = 2 * static_cast<std::size_t>(places_of(grid));
  const std::size_t all = field * static_cast<std::size_t>(channels);
  const std::size_t columns =
      sizeof(std::int32_t) * static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.z);
  const gpu::Device& device = kernels_->device();
  const std::uint64_t room = device.memory(), wanted = 2 * all + 2 * field + (kColumnKinds + 3) * columns;
  if (all > device.largest_piece() || state.taken + wanted > room - room / 16)
    throw gpu::DeviceError("the device has no room for a picture beside the state");
  gpu::Device& on = kernels_->device();
  for (Buffer* buffer : {&now_, &next_}) *buffer = on.allocate(all);
  for (Buffer* buffer : {&as_solid_, &as_liquid_}) *buffer = on.allocate(field);
  columns_ = on.allocate(kColumnKinds * columns);
  pressed_ = on.allocate(sizeof(std::int32_t));
  for (Buffer* buffer : {&levels_, &next_levels_, &heights_}) *buffer = on.allocate(columns);
  known_heights_.clear();
  std::vector<std::int64_t> numbers = gpu::shape_numbers(*state.shape);
  shape_ = on.allocate(sizeof(std::int64_t) * numbers.size());
  kernels_->write(*shape_, std::move(numbers));
  grid_ = grid;
  channels_ = channels;
}

void DeviceField::find_columns(const gpu::StateOnDevice& state, const scene::Terrain& terrain, int passes) {
  std::vector<std::int32_t> heights = heights_of(terrain, grid_);
  if (!heights.empty() && heights != known_heights_) kernels_->write(*heights_, heights);
  known_heights_ = std::move(heights);
  kernels_->device().clear(*pressed_, sizeof(std::int32_t));
  kernels_->run(PictureKernel::find_columns, state.groups,
                {shape_.get(), state.flags, state.amount, heights_.get(), known_heights_.empty() ? 0 : 1,
                 columns_.get(), pressed_.get()});
  kernels_->run(PictureKernel::begin_levels, state.groups, {shape_.get(), columns_.get(), levels_.get()});
  for (int pass = 0; pass < std::min(4 * passes, 12); ++pass) {
    kernels_->run(PictureKernel::smooth_levels, state.groups,
                  {shape_.get(), levels_.get(), next_levels_.get()});
    levels_.swap(next_levels_);
  }
}

void DeviceField::filter(const gpu::StateOnDevice& state, int liquid_passes, int solid_passes) {
  const auto keep = [&](int pass) {
    for (const auto& [passes, kept] : {std::pair(solid_passes, &as_solid_), {liquid_passes, &as_liquid_}})
      if (passes == pass)
        kernels_->run(PictureKernel::keep_intensity, state.groups, {shape_.get(), now_.get(), kept->get()});
  };
  keep(0);
  for (int pass = 1; pass <= std::max({liquid_passes, solid_passes, 1}); ++pass) {
    for (const int axis : {2, 1, 0}) {
      kernels_->run(PictureKernel::filter_axis, state.groups,
                    {shape_.get(), now_.get(), next_.get(), channels_, axis});
      now_.swap(next_);
    }
    keep(pass);
  }
  kernels_->run(PictureKernel::mix_intensity, state.groups,
                {shape_.get(), now_.get(), as_solid_.get(), as_liquid_.get()});
}

void DeviceField::update(const gpu::StateOnDevice& state, const scene::Look& look,
                         const scene::Terrain& terrain) {
  const std::optional<Tones> tones = tones_of(look);
  const std::int32_t shows = look.glow && state.heat != nullptr ? kShowsHeat : tones ? kShowsTones : kNoHeat;
  resize(state, shows == kNoHeat ? kHeatChannel : kHeatChannel + 1);
  if (tones) {
    if (!tones_) tones_ = kernels_->device().allocate(sizeof(std::int32_t) * tones->size());
    kernels_->write(*tones_, std::vector<std::int32_t>(tones->begin(), tones->end()));
  }
  const int liquid_passes = std::clamp(look.smooth, 0, kMaxPasses);
  const int solid_passes = std::clamp(look.smooth_solid, 0, kMaxPasses);
  passes_ = liquid_passes;
  find_columns(state, terrain, liquid_passes);
  kernels_->run(
      PictureKernel::put_matter, state.groups,
      {shape_.get(), state.flags, state.amount, state.heat, columns_.get(), tones_.get(), shows, now_.get()});
  kernels_->run(PictureKernel::fill_columns, state.groups,
                {shape_.get(), state.flags, state.amount, columns_.get(), levels_.get(),
                 liquid_passes > 0 ? 1 : 0, now_.get()});
  kernels_->run(PictureKernel::fill_rim, state.groups, {shape_.get(), now_.get(), channels_});
  filter(state, liquid_passes, solid_passes);
  kernels_->device().flush();
}

std::vector<std::uint16_t> DeviceField::fetch(int channel) const {
  std::vector<std::uint16_t> cells(grid_.cells());
  if (channel >= channels_) return cells;
  const std::vector<std::uint16_t> all =
      kernels_->read<std::uint16_t>(*now_, places() * static_cast<std::size_t>(channels_));
  const auto wide = static_cast<std::size_t>(grid_.x) + 2 * kRim,
             high = static_cast<std::size_t>(grid_.y) + 2 * kRim;
  for (int z = 0; z < grid_.z; ++z)
    for (int y = 0; y < grid_.y; ++y) {
      const std::size_t from =
          places() * static_cast<std::size_t>(channel) +
          ((static_cast<std::size_t>(z) + kRim) * high + static_cast<std::size_t>(y) + kRim) * wide + kRim;
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(from), grid_.x,
                  cells.begin() + static_cast<std::ptrdiff_t>(grid_.index(0, y, z)));
    }
  return cells;
}

std::vector<std::int32_t> DeviceField::fetch_columns(int kinds) const {
  return kernels_->read<std::int32_t>(*columns_, static_cast<std::size_t>(kinds) * columns_of_all());
}

std::vector<std::int32_t> DeviceField::fetch_ground() const {
  const std::vector<std::int32_t> all = fetch_columns(kOffset + 1);
  const std::size_t columns = columns_of_all();
  std::vector<std::int32_t> ground(columns);
  for (std::size_t c = 0; c < columns; ++c)
    ground[c] = all[kBed * columns + c] * 4096 + all[kOffset * columns + c];
  return ground;
}

std::int32_t DeviceField::fetch_pressed() const { return kernels_->read<std::int32_t>(*pressed_, 1).front(); }

std::vector<std::int32_t> DeviceField::fetch_wetness() const { return fetch_columns(kFilm + 1); }

}  // namespace voxmelt::render
