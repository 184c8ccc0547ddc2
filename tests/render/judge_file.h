// Writes pictures as files for the judge (tests/picture_judge), and reads its answers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/image/image.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::test {

// Returns a file in the folder for such files, with the number of this process.
std::filesystem::path judge_file_name(const std::string& name);

void write_judge_file(const std::filesystem::path& file, const state::Volume& volume, const scene::Look& look,
                      const scene::Light& light, const scene::Terrain& terrain, const scene::Camera& camera,
                      render::Setting setting);

// Throws std::runtime_error if the judge fails.
render::Image judged_picture(const std::filesystem::path& file, int width, int height);

// Returns filtered intensity, solid, liquid, heat and obstacle of each cell, two bytes each, and then drawn
// heights, four bytes.
std::vector<std::uint8_t> judged_field(const std::filesystem::path& file);

// Says what the middle of a pixel shows: 0 nothing, 1 matter, 2 the ground. The place is in 2^-20 cells, and
// the depth is z of docs/picture/definition.md, section 8.
struct JudgedSurface {
  std::int64_t kind = 0, x = 0, y = 0, z = 0, depth = 0;
  friend bool operator==(const JudgedSurface&, const JudgedSurface&) = default;
};
std::vector<JudgedSurface> judged_surface(const std::filesystem::path& file);

}  // namespace voxmelt::test
