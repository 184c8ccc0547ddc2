#include "tests/render/judge_file.h"

#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/kernel/worlds.h"

namespace voxmelt::test {
namespace {

// Numbers have 17 digits, which read back exactly.
std::string text_of(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) {
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), " %.17g", number);
    text += digits.data();
  }
  return text + "\n";
}
std::string text_of(const scene::Vec3& v) { return text_of({v[0], v[1], v[2]}); }

std::string materials_of(const scene::Look& look) {
  std::string text;
  for (const scene::Vec3& color : look.materials) text += "material" + text_of(color);
  return text;
}

void put16(std::string& bytes, std::uint16_t value) {
  bytes += static_cast<char>(value & 255);
  bytes += static_cast<char>(value >> 8);
}

std::string data_of(const state::Volume& volume, std::size_t colors, const scene::Terrain& terrain) {
  std::string masks, amounts, heats, materials;
  worlds::for_each(worlds::whole(volume.grid), [&](int x, int y, int z) {
    masks += static_cast<char>((volume.solid.test(x, y, z) ? 1 : 0) | (volume.liquid.test(x, y, z) ? 2 : 0) |
                               (volume.inert.test(x, y, z) ? 4 : 0));
    put16(amounts, volume.amount[volume.at(x, y, z)]);
    put16(heats, volume.heat[volume.at(x, y, z)]);
    if (colors > 0)
      materials += static_cast<char>(volume.material.empty() ? 0 : volume.material[volume.at(x, y, z)]);
  });
  std::string heights(terrain.height.size() * sizeof(float), '\0');
  if (!heights.empty()) std::memcpy(heights.data(), terrain.height.data(), heights.size());
  return masks + amounts + heats + materials + heights;
}

std::vector<std::uint8_t> judged(const char* option, const std::filesystem::path& file) {
  std::string command(VOXMELT_JUDGE);
  for (const std::string& word : {std::string(option), file.string()})
    command.append(" '").append(word).append("'");
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::vector<std::uint8_t> bytes, part(65536);
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    bytes.insert(bytes.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(n));
  if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
  return bytes;
}

}  // namespace

std::filesystem::path judge_file_name(const std::string& name) {
  std::ostringstream file;
  file << "voxmelt_" << name << '_' << getpid() << ".picture";
  return std::filesystem::temp_directory_path() / file.str();
}

void write_judge_file(const std::filesystem::path& file, const state::Volume& volume, const scene::Look& look,
                      const scene::Light& light, const scene::Terrain& terrain, const scene::Camera& camera,
                      render::Setting setting) {
  const state::Grid& grid = volume.grid;
  const bool given = terrain.x == grid.x && terrain.z == grid.z && !terrain.height.empty();
  constexpr std::array kSettings{"fast", "normal", "best"};
  std::ofstream out(file, std::ios::binary);
  out << "voxmelt-picture 1\n"
      << "grid" << text_of({1.0 * grid.x, 1.0 * grid.y, 1.0 * grid.z})  //
      << "smooth" << text_of({1.0 * look.smooth, 1.0 * look.smooth_solid}) << "solid" << text_of(look.solid)
      << "liquid" << text_of(look.liquid) << "ground" << text_of(look.ground) << "background"
      << text_of(look.background) << "shininess" << text_of({look.shininess}) << "specular"
      << text_of({look.specular}) << "metallic" << text_of({look.metallic}) << "glow"
      << text_of({look.glow ? 1.0 : 0.0, look.glow_cold, look.glow_hot})
      << (look.clear != scene::Vec3{}
              ? "clear" + text_of({look.clear[0], look.clear[1], look.clear[2], look.frost})
              : "")
      << materials_of(look) << "light"
      << text_of({light.direction[0], light.direction[1], light.direction[2], light.ambient}) << "camera"
      << text_of({camera.target[0], camera.target[1], camera.target[2], camera.azimuth, camera.elevation,
                  camera.distance, camera.field_of_view, 1.0 * camera.width, 1.0 * camera.height})
      << (camera.orthographic ? "orthographic\n" : "")  //
      << "terrain" << text_of({given ? 1.0 : 0.0, terrain.textured ? 1.0 : 0.0}) << "setting "
      << kSettings[static_cast<std::size_t>(setting)] << "\ndata\n"
      << data_of(volume, look.materials.size(), given ? terrain : scene::Terrain{});
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

render::Image judged_picture(const std::filesystem::path& file, int width, int height) {
  const std::vector<std::uint8_t> bytes = judged("--picture", file);
  render::Image image(width, height);
  if (bytes.size() != image.pixels.size() * sizeof(render::Rgb))
    throw std::runtime_error("the judge drew another size");
  std::memcpy(image.pixels.data(), bytes.data(), bytes.size());
  return image;
}

std::vector<JudgedSurface> judged_surface(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = judged("--surface", file);
  std::vector<JudgedSurface> pixels(bytes.size() / sizeof(JudgedSurface));
  std::memcpy(pixels.data(), bytes.data(), pixels.size() * sizeof(JudgedSurface));
  return pixels;
}

std::vector<std::uint8_t> judged_field(const std::filesystem::path& file) { return judged("--field", file); }

}  // namespace voxmelt::test
