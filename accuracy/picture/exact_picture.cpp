#include "accuracy/picture/exact_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "accuracy/picture/sampling.h"

namespace voxmelt::accuracy {
namespace {

// Matter cut off at a side of the grid and the side of the slab lie in one plane. There the slab shows, by
// half a step of the best picture.
constexpr double kSideFirst = 1.0 / 16;

}  // namespace

ExactPicture::ExactPicture(const ExactScene& scene, const picture::Camera& camera, picture::Vector cells)
    : scene_(scene),
      width_(static_cast<double>(camera.width)),
      height_(static_cast<double>(camera.height)),
      distance_(static_cast<double>(camera.distance) / 4096),
      parallel_(camera.parallel) {
  const auto radians = [](std::int64_t angle) {
    return static_cast<double>(angle) / picture::kDegree * std::numbers::pi / 180;
  };
  const double azimuth = radians(camera.azimuth), elevation = radians(camera.elevation);
  const double sa = std::sin(azimuth), ca = std::cos(azimuth), se = std::sin(elevation),
               ce = std::cos(elevation);
  forward_ = {-sa * ce, -se, -ca * ce};
  right_ = {ca, 0, -sa};
  up_ = {-sa * se, ce, -ca * se};
  tangent_ = std::tan(radians(camera.half_field));
  eye_ = exact(camera.target, picture::kCell) - forward_ * distance_;
  double near = 1e30;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = [&](int bit, std::int64_t n) {
      return (corner & bit) != 0 ? static_cast<double>(n) + 0.5 : -0.5;
    };
    near = std::min(near, dot(Exact{at(1, cells.x), at(2, cells.y), at(4, cells.z)} - eye_, forward_));
  }
  near_ = parallel_ ? near : std::max(0.0, near);
}

ExactRay ExactPicture::ray(double across, double down) const {
  const double scale = tangent_ / (height_ / 2);
  const Exact aside = right_ * ((across - width_ / 2) * scale) + up_ * ((height_ / 2 - down) * scale);
  const Exact direction = parallel_ ? forward_ : forward_ + aside;
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  const Exact start = parallel_ ? eye_ + forward_ * near_ + aside * distance_ : eye_ + direction * near_;
  return {start, direction * (1 / largest)};
}

Exact ExactPicture::light(double across, double down) const {
  const ExactRay ray = this->ray(across, down);
  const double matter = scene_.field.first_crossing(ray);
  const ExactGround::Crossing ground = scene_.ground.first_crossing(ray);
  const Exact to_eye = unit(ray.along * -1);
  const double bias = ground.face == picture::Face::top ? 0 : kSideFirst;
  if (ground.place >= 0 && (matter < 0 || ground.place <= matter + bias)) {
    const Exact p = ray.at(ground.place);
    ExactGround::Surface surface = scene_.ground.surface(p, ground.face);
    if (ground.face == picture::Face::none) surface.normal = to_eye;
    return pressed(scene_.shade.ground_color(p, surface.normal, surface.color));
  }
  if (matter < 0) return scene_.background;
  const Exact p = ray.at(matter), normal = matter == 0 ? to_eye : scene_.field.normal(p);
  ExactField::Matter the_matter = scene_.field.matter(p);
  if (scene_.field.obstacles()) the_matter.obstacle = scene_.field.matter(p + normal * 0.5).obstacle;
  return pressed(scene_.shade.matter_color(p, normal, to_eye, the_matter));
}

ExactPicture::Seen ExactPicture::matter(double across, double down) const {
  const ExactRay ray = this->ray(across, down);
  const double place = scene_.field.first_crossing(ray);
  if (place < 0) return {};
  const Exact p = ray.at(place);
  return {dot(p - eye_, forward_) - near_, p, scene_.field.normal(p)};
}

render::Rgb ExactPicture::pixel(int x, int y, std::span<const picture::Sub> samples, double one) const {
  Exact sum;
  for (const picture::Sub& sub : samples) sum = sum + light(x + sub.across / one, y + sub.down / one);
  return bytes_of(sum * (1.0 / static_cast<double>(samples.size())));
}

render::Image ExactPicture::draw(cpu::Workers& workers) const {
  return sampled(
             static_cast<int>(width_), static_cast<int>(height_), lattice_sampling(),
             [&](int x, int y, Places places) { return pixel(x, y, places); }, workers)
      .image;
}

}  // namespace voxmelt::accuracy
