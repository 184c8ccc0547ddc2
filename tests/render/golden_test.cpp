// The digests of pictures are approved (picture_digests.txt). The pictures show scenes in mid-melt from all
// around, in every setting, by every instruction set on 1 to 8 threads. The reference draws a sample of them,
// and the judge some.
//
// VOXMELT_APPROVE=1 writes the digests of this program, unless something disagrees. Both programs have their
// own: the quick one 64 x 64 pixels, the slow one 256 x 256.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ios>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/reference_picture.h"
#include "tests/render/judge_file.h"
#include "tests/render/picture_pairs.h"

namespace voxmelt {
namespace {

using render::Image;
using render::Setting;
using test::difference;

#ifdef VOXMELT_SLOW
constexpr int kSide = 256, kViews = 20, kFirstView = 0, kNextView = 1, kJudgedView = 11;
#else
constexpr int kSide = 64, kViews = 8, kFirstView = 0, kNextView = 7, kJudgedView = -1;
#endif
constexpr int kMostThreads = 8;

using Digests = std::map<std::string, std::string>;  // by size, scene, setting and view

Digests approved_digests() {
  Digests digests;
  std::ifstream file(VOXMELT_PICTURE_DIGESTS);
  for (std::string line; std::getline(file, line);) {
    const std::size_t space = line.rfind(' ');
    digests[line.substr(0, space)] = line.substr(space + 1);
  }
  return digests;
}

// Computes the FNV-1a hash of the pixels.
std::string digest_of(const Image& image) {
  std::uint64_t hash = 0xCBF29CE484222325;
  for (const render::Rgb& pixel : image.pixels)
    for (const std::uint8_t byte : pixel) hash = (hash ^ byte) * 0x100000001B3;
  std::ostringstream text;
  text << std::hex << hash;
  return text.str();
}

// The views are from all sides, from above and below, and every fourth one is from near or within.
scene::Camera view_of(const scene::Scene& scene, int view) {
  constexpr std::array kElevations{28.0, 5.0, 60.0, -30.0, 88.0};
  scene::Camera camera = scene.camera;
  camera.azimuth += 18 * view;
  camera.elevation = kElevations[static_cast<std::size_t>(view) % kElevations.size()];
  camera.distance = view % 4 == 3 ? 0.3 * scene.initial.grid.x : 0;
  camera.width = camera.height = kSide;
  return camera;
}

struct Shown {
  const scene::Scene& scene;
  const state::Volume& volume;
  const render::Picture& picture;
  const render::PictureScene& reference;
};

// Draws the picture with all instruction sets. The number of threads goes round with the views.
Image drawn(const Shown& shown, const scene::Camera& camera, Setting setting, int view) {
  Image first;
  int threads = view;
  cpu::for_each_instruction_set([&]<cpu::InstructionSet kSet>() {
    if (!cpu::supported(kSet)) return;
    threads = threads % kMostThreads + 1;
    const Image image = shown.picture.draw(camera, setting, threads, render::packets_of(kSet));
    if (first.pixels.empty()) first = image;
    EXPECT_EQ(difference(first, image), "") << cpu::name_of(kSet) << ", " << threads << " threads";
  });
  return first;
}

void expect_judge_agrees(const Shown& shown, const scene::Camera& camera, Setting setting,
                         const Image& image) {
  const std::filesystem::path file = test::judge_file_name("golden");
  test::write_judge_file(file, shown.volume, shown.scene.look, shown.scene.light, shown.scene.terrain, camera,
                         setting);
  EXPECT_EQ(difference(test::judged_picture(file, camera.width, camera.height), image), "") << "the judge";
  std::filesystem::remove(file);
}

void draw_scene(const std::string& name, int steps, const Digests& approved, bool approve, Digests& found) {
  scene::Scene scene = scene::load(VOXMELT_SCENES_FOLDER "/" + name + ".toml", {});
  run::Simulation simulation(scene.parameters, scene.initial, run::implementations().widest(), {});
  for (int i = 0; i < steps; ++i) simulation.step();
  render::Picture picture;
  picture.update(simulation.volume(), scene.look, scene.light, scene.terrain, 2);
  render::DensityField field;
  field.update(simulation.volume(), scene.look, scene.terrain, 2);
  const render::PictureScene reference(field, scene.look, scene.light, scene.terrain);
  const Shown shown{scene, simulation.volume(), picture, reference};

  constexpr std::array<std::pair<const char*, Setting>, 3> kSettings{
      {{"fast", Setting::fast}, {"normal", Setting::normal}, {"best", Setting::best}}};
  for (const auto& [word, setting] : kSettings)
    for (int view = kFirstView; view < kViews; view += kNextView) {
      std::ostringstream key;
      key << kSide << ' ' << name << ' ' << steps << ' ' << word << ' ' << view;
      SCOPED_TRACE(key.str());
      const scene::Camera camera = view_of(scene, view);
      const Image image = drawn(shown, camera, setting, view);
      found[key.str()] = digest_of(image);
      if (view % 10 == 7) {
        const Image plain = reference_picture(reference, render::camera_in_integers(camera), setting);
        EXPECT_EQ(difference(plain, image), "") << "the reference";
      }
      if (view == kJudgedView && setting == Setting::normal)
        expect_judge_agrees(shown, camera, setting, image);
      if (approve) continue;
      const auto known = approved.find(key.str());
      if (known == approved.end()) {
        ADD_FAILURE() << "no digest is approved";
        continue;
      }
      EXPECT_EQ(known->second, found[key.str()]);
    }
}

TEST(Golden, PicturesAreThoseApproved) {
  Digests approved = approved_digests();
  const bool approve = std::getenv("VOXMELT_APPROVE") != nullptr;
  Digests found;
  for (const auto& [name, steps] : std::map<std::string, int>{{"cello", 300},
                                                              {"goblet", 300},
                                                              {"lava", 600},
                                                              {"lava_viscous", 400},
                                                              {"bunny", 400},
                                                              {"proving_ground", 60}})
    draw_scene(name, steps, approved, approve, found);
  if (!approve) return;
  ASSERT_FALSE(HasFailure()) << "not approved: something disagrees";
  for (const auto& [key, digest] : found) approved[key] = digest;
  std::ofstream file(VOXMELT_PICTURE_DIGESTS);
  for (const auto& [key, digest] : approved) file << key << ' ' << digest << '\n';
}

}  // namespace
}  // namespace voxmelt
