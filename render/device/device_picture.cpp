#include "render/device/device_picture.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "render/density/columns.h"
#include "render/packet/scene_in_integers.h"
#include "render/rule/antialias.h"
#include "render/rule/light_grid.h"

namespace voxmelt::render {
namespace {

constexpr std::size_t kLightBytes = 16;  // as in program/light_volume.cl
constexpr int kOpenSweeps = 6, kAllSweeps = 12;

std::size_t blocks_of(const state::Grid& grid) {
  const auto along = [](int side) { return static_cast<std::size_t>(side) / 4 + 1; };
  return along(grid.x) * along(grid.y) * along(grid.z);
}

}  // namespace

bool device_draws(const gpu::StateOnDevice& state, const scene::Look& look) {
  return !look.glow || state.heat != nullptr;
}

void DevicePicture::make_room(Buffer& buffer, std::size_t& has, std::size_t wanted) {
  if (wanted <= has) return;
  buffer.reset();
  has = 0;
  buffer = kernels_->device().allocate(wanted);
  has = wanted;
}

template <class Number>
void DevicePicture::write(Buffer& to, std::vector<Number> numbers) {
  if (!to) to = kernels_->device().allocate(sizeof(Number) * numbers.size());
  kernels_->write(*to, std::move(numbers));
}

void DevicePicture::update(const gpu::StateOnDevice& state, const scene::Look& look,
                           const scene::Light& light, const scene::Terrain& terrain) {
  const bool same = terrain_ && *terrain_ == terrain && scene_look_ == look && scene_light_ == light &&
                    grid_ == state.shape->grid;
  if (same && version_ == state.version) return;
  terrain_.reset();  // until all of it is done
  groups_ = kernels_->device().most_groups();
  field_.update(state, look, terrain);
  if (!same) {
    grid_ = state.shape->grid;
    look_ = look_in_integers(look);
    paint_ = picture::paint_of(look_, lamp_in_integers(light));
    const picture::Vector cells = picture::light_cells({grid_.x, grid_.y, grid_.z});
    const int shift = picture::light_shift({grid_.x, grid_.y, grid_.z});
    write(paint_numbers_, paint_numbers(look_, paint_, shift));
    lamp_ = lamp_sweep(paint_.to_light, cells);
    put_light(numbers_, lamp_, cells, shift);
    for (Buffer* buffer : {&blocks_, &next_blocks_, &ground_numbers_, &texels_, &rays_, &left_rays_,
                           &soft_rays_, &light_matter_, &light_, &along_})
      buffer->reset();
  }
  find_ground(look, terrain, same);
  write(view_, numbers_);
  find_levels();
  find_light();
  kernels_->device().flush();
  version_ = state.version;
  terrain_ = terrain;
  scene_look_ = look;
  scene_light_ = light;
}

void DevicePicture::find_ground(const scene::Look& look, const scene::Terrain& terrain, bool same) {
  if (!same) {
    const bool given = fits(terrain, grid_);
    ground_ = GroundMap({grid_.x, grid_.y, grid_.z}, given ? ground_heights(terrain) : field_.fetch_ground(),
                        field_.passes(), look.ground, terrain.textured && given);
    write(texels_, texel_numbers(ground_));
  }
  const bool lowered = !ground_.empty() && ground_.lower(field_.fetch_wetness());
  if (same && !lowered) return;
  put_ground(numbers_, ground_);
  write(ground_numbers_, same ? ground_.drawn() : ground_numbers(ground_));
}

void DevicePicture::find_levels() {
  const gpu::Memory *lattice = field_.lattice(), *levels = field_.small_room();
  run(PictureKernel::prefilter_x, {lattice, field_.channels(), levels});
  run(PictureKernel::prefilter_y, {lattice, levels, field_.other_small_room()});
  run(PictureKernel::make_levels, {lattice, field_.other_small_room(), levels});
  run(PictureKernel::find_shares, {lattice, paint_numbers_.get(), field_.channels(), levels, field_.room()});
  const std::size_t blocks = blocks_of(grid_);
  for (Buffer* buffer : {&blocks_, &next_blocks_})
    if (!*buffer) *buffer = kernels_->device().allocate(blocks);
  run(PictureKernel::find_blocks, {lattice, levels, blocks_.get()});
  for (const int axis : {0, 1, 2}) {
    run(PictureKernel::spread_blocks, {lattice, blocks_.get(), next_blocks_.get(), axis});
    blocks_.swap(next_blocks_);
  }
}

void DevicePicture::find_light() {
  const picture::Vector count = picture::light_cells({grid_.x, grid_.y, grid_.z});
  const auto cells = static_cast<std::size_t>(count.x * count.y * count.z);
  const auto slice =
      static_cast<std::size_t>(std::max({count.x * count.y, count.y * count.z, count.x * count.z}));
  gpu::Device& device = kernels_->device();
  if (!light_) {
    light_matter_ = device.allocate(2 * cells);
    light_ = device.allocate(kLightBytes * cells);
    along_ = device.allocate(kAllSweeps * slice);
    for (Buffer* buffer : {&rays_, &left_rays_, &soft_rays_})
      *buffer = device.allocate(static_cast<std::size_t>(lamp_.rays_u * lamp_.rays_v));
  }
  const gpu::Memory *lattice = field_.lattice(), *view = view_.get(), *matter = light_matter_.get();
  run(PictureKernel::find_density,
      {lattice, view, paint_numbers_.get(), field_.channels(), ground_numbers_.get(), matter});
  run(PictureKernel::begin_lamp, {lattice, view, rays_.get()});
  const int sweeps = look_.glow ? kAllSweeps : kOpenSweeps;
  const auto slices = static_cast<int>(std::max({count.x, count.y, count.z}));
  for (int s = 0; s < slices; ++s) {
    run(PictureKernel::sweep_u, {lattice, view, matter, light_.get(), along_.get(), sweeps, s});
    run(PictureKernel::sweep_v, {lattice, view, along_.get(), light_.get(), sweeps, s});
    if (s >= lamp_.slices) continue;
    run(PictureKernel::pass_lamp, {lattice, view, matter, rays_.get(), left_rays_.get(), light_.get(), s});
    run(PictureKernel::soften_lamp, {lattice, view, left_rays_.get(), soft_rays_.get(), 0});
    run(PictureKernel::soften_lamp, {lattice, view, soft_rays_.get(), rays_.get(), 1});
  }
}

Image DevicePicture::draw(const scene::Camera& scene_camera, Setting setting) {
  const picture::Camera camera = camera_in_integers(scene_camera);
  const picture::View view = picture::view_of(camera, {grid_.x, grid_.y, grid_.z});
  put_view(numbers_, view, camera, spacing_of(setting, view));
  write(view_, numbers_);
  const auto pixels = static_cast<std::size_t>(camera.width * camera.height);
  if (3 * pixels > std::numeric_limits<std::int32_t>::max())
    throw gpu::DeviceError("the picture is too large for a device");
  make_room(image_, image_room_, sizeof(Rgb) * pixels);
  const auto* lattice = field_.lattice();
  const gpu::Memory *levels = field_.small_room(), *shares = field_.room();
  run(PictureKernel::draw_middles, {lattice, view_.get(), paint_numbers_.get(), levels, shares, blocks_.get(),
                                    light_.get(), ground_numbers_.get(), texels_.get(), image_.get()});
  if (setting != Setting::fast) {
    const bool best = setting == Setting::best;
    make_room(list_, list_room_, sizeof(std::int32_t) * pixels);
    if (!count_) count_ = kernels_->device().allocate(sizeof(std::int32_t));
    kernels_->device().clear(*count_, sizeof(std::int32_t));
    run(PictureKernel::find_differing, {view_.get(), image_.get(), list_.get(), count_.get(),
                                        best ? picture::kFineDifference : picture::kDifference});
    run(PictureKernel::refine,
        {lattice, view_.get(), paint_numbers_.get(), levels, shares, blocks_.get(), light_.get(),
         ground_numbers_.get(), texels_.get(), list_.get(), count_.get(), best ? 32 : 8, image_.get()});
  }
  Image image(static_cast<int>(camera.width), static_cast<int>(camera.height));
  image.pixels = kernels_->read<Rgb>(*image_, pixels);
  return image;
}

std::vector<LightBytes> DevicePicture::fetch_light() const {
  const picture::Vector count = picture::light_cells({grid_.x, grid_.y, grid_.z});
  const auto cells = static_cast<std::size_t>(count.x * count.y * count.z);
  const std::vector<std::uint8_t> bytes = kernels_->read<std::uint8_t>(*light_, kLightBytes * cells);
  std::vector<LightBytes> all(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const std::uint8_t* from = bytes.data() + kLightBytes * i;
    all[i].lamp = from[0];
    std::copy_n(from + 1, picture::kSides, all[i].open.begin());
    std::copy_n(from + 1 + picture::kSides, picture::kSides, all[i].glow.begin());
  }
  return all;
}

}  // namespace voxmelt::render
