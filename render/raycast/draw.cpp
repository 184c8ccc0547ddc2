#include "render/raycast/draw.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <thread>
#include <vector>

#include "render/image/camera.h"
#include "render/image/color.h"
#include "render/raycast/ground.h"
#include "render/raycast/light.h"
#include "render/raycast/material.h"
#include "render/raycast/occlusion.h"
#include "render/raycast/rock.h"
#include "render/raycast/surface.h"

namespace voxmelt::render {
namespace {

// Light that arrives at a point. It varies slowly, so the samples of one pixel share it where they meet the
// same smooth piece of surface. Each pixel starts anew, so the order of pixels does not matter.
struct Arriving {
  bool known = false;
  Vec point, normal;
  float lamp = 1, mirrored = 1;
  Ambient ambient;

  bool serves(Vec p, Vec n) const {
    constexpr float kNear = 0.4f, kAlike = 0.985f;
    return known && dot(p - point, p - point) < kNear * kNear && dot(n, normal) > kAlike;
  }
};

class Painter {
 public:
  Painter(const DensityField& field, const scene::Camera& camera, const scene::Light& light,
          const scene::Look& look, const scene::Terrain& terrain, const DrawSettings& settings)
      : field_(field),
        look_(look),
        view_(camera, field.grid()),
        surface_(field, settings.skip_empty),
        ground_(terrain, field),
        occlusion_(field.pyramid()),
        to_light_(normalized(vec(light.direction))),
        ambient_(static_cast<float>(light.ambient)),
        samples_(std::max(1, settings.antialias)) {}

  void paint_row(Image& image, int y) const {
    const float step = 1 / static_cast<float>(samples_);
    for (int x = 0; x < image.width; ++x) {
      Vec sum;
      Arriving at_matter, at_ground;
      for (int sy = 0; sy < samples_; ++sy)
        for (int sx = 0; sx < samples_; ++sx)
          sum += color(view_.ray(static_cast<float>(x) + (static_cast<float>(sx) + 0.5f) * step,
                                 static_cast<float>(y) + (static_cast<float>(sy) + 0.5f) * step),
                       at_matter, at_ground);
      image.at(x, y) = srgb(sum * (step * step));
    }
  }

 private:
  // The nearer of ground and matter.
  Vec color(const Ray& ray, Arriving& at_matter, Arriving& at_ground) const {
    const std::optional<GroundHit> ground = ground_.find(ray);
    float limit = ground ? ground->hit.distance : std::numeric_limits<float>::max();
    if (ground && ground->side)
      limit -= 0.01f;  // cut matter and the slab end in the same plane: the slab wins
    if (const std::optional<Hit> hit = surface_.find(ray, limit)) return matter_color(ray, *hit, at_matter);
    if (ground) return ground_color(ray, *ground, at_ground);
    return vec(look_.background);
  }

  void gather(Arriving& arriving, const Ray& ray, Vec point, Vec normal, bool mirrors) const {
    if (arriving.serves(point, normal)) return;
    arriving = {true, point, normal, 0, 1, occlusion_.ambient(point, normal)};
    if (dot(normal, to_light_) > -0.2f)
      arriving.lamp =
          occlusion_.light_reaching(point, normal, to_light_) * ground_.light_reaching(point, to_light_);
    if (mirrors)
      arriving.mirrored = occlusion_.reflection_reaching(
          point, normal, ray.direction - normal * (2 * dot(normal, ray.direction)));
  }

  Incoming incoming(const Ray& ray, Vec normal, const Arriving& arriving) const {
    return {normal, -ray.direction, to_light_, arriving.lamp, arriving.ambient.open, arriving.mirrored, 0};
  }

  Vec matter_color(const Ray& ray, const Hit& hit, Arriving& arriving) const {
    const Material material = material_at(field_, surface_.sampler(), hit.point, hit.normal, look_);
    gather(arriving, ray, hit.point, hit.normal, material.metallic > 0);
    Incoming in = incoming(ray, hit.normal, arriving);
    if (look_.glow) in.glow = arriving.ambient.glow * material.obstacle;
    return tone_mapped(reflected(material, in, ambient_, vec(look_.ground)));
  }

  Vec ground_color(const Ray& ray, const GroundHit& where, Arriving& arriving) const {
    const RockSample sample = rock(ground_, where, look_);
    Material material;
    material.color = sample.color;
    material.specular = 0.03f;
    material.shininess = 12;
    gather(arriving, ray, where.hit.point, where.hit.normal, false);
    Incoming in = incoming(ray, sample.normal, arriving);
    if (!where.side) in.open *= ground_.openness(where.hit.point.x, where.hit.point.z);
    // Matter has its own light in its emission. That light falls only on its surroundings.
    if (look_.glow) in.glow = arriving.ambient.glow;
    return tone_mapped(reflected(material, in, ambient_, vec(look_.ground)));
  }

  const DensityField& field_;
  const scene::Look look_;
  const CameraView view_;
  const Surface surface_;
  const Ground ground_;
  const Occlusion occlusion_;
  const Vec to_light_;
  const float ambient_;
  const int samples_;
};

}  // namespace

Image draw(const DensityField& field, const scene::Camera& camera, const scene::Light& light,
           const scene::Look& look, const scene::Terrain& terrain, const DrawSettings& settings) {
  Image image(camera.width, camera.height);
  const Painter painter(field, camera, light, look, terrain, settings);

  // Rows are handed out one by one. Each depends on nothing but the scene.
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int y = next++; y < image.height; y = next++) painter.paint_row(image, y);
  };
  const int wanted =
      settings.threads > 0 ? settings.threads : static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::jthread> helpers;
  for (int i = 1; i < std::min(wanted, image.height); ++i) helpers.emplace_back(work);
  work();
  helpers.clear();  // joins: the picture is complete before it is handed out
  return image;
}

}  // namespace voxmelt::render
