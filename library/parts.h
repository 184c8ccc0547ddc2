// A Simulation of the public face is made of these parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "library/by_hand.h"
#include "library/journal/journal.h"
#include "library/journal/world.h"
#include "library/version_numbers.h"
#include "render/device/picture_on_device.h"
#include "render/packet/picture.h"
#include "render/textures/picture_textures.h"
#include "voxmelt/voxmelt.h"

namespace voxmelt {

class Simulation::Parts {
 public:
  Parts(const std::filesystem::path& file, const Options& options);

  void step();  // and the scene's changes before it
  void restart();
  void save(const std::filesystem::path& place) const;
  Changes changes(std::uint64_t since);

  // Returns the picture of the present state. It keeps what has not changed since the last one.
  render::Picture& up_to_date();
  // Draws the present state on the device that has it. There is no image if that cannot draw it.
  std::optional<render::Image> drawn_on_device(const scene::Camera& camera, render::Setting setting);
  // Returns the textures of the present state. They are kept from their first call on.
  const render::PictureTextures& textures();

  const step::Implementation& implementation;
  const int threads;

 private:
  // Holds a scene as a file gave it, and what a checkpoint knows of the files behind it.
  struct Opened {
    scene::Scene scene;
    std::vector<checkpoint::FileState> files;
    std::uint64_t digest = 0;  // digest of the first state
  };
  static Opened open(const std::filesystem::path& file, const Options& options);
  run::Simulation begin(scene::Scene& scene) const;

  const std::filesystem::path file_;
  const Options options_;
  Opened opened_;  // its cells have moved on; its parameters and settings are the present ones

 public:
  run::Simulation simulation;
  library::ByHand by_hand;
  const scene::Scene& scene() const { return opened_.scene; }

 private:
  journal::WorldOf<library::ByHand> world_;
  journal::Reader timeline_;  // changes of the scene
  render::Picture picture_;
  render::PictureOnDevice on_device_;
  render::PictureTextures textures_;
  library::VersionNumbers versions_;
};

}  // namespace voxmelt
