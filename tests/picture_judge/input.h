// The input file describes a state, a look, a light, a terrain and a camera.
#pragma once
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>
#include "numbers.h"

struct ColorNumbers {
  double red = 0, green = 0, blue = 0;
};

struct Input {
  Int nx = 0, ny = 0, nz = 0;
  Int smooth = 0, smooth_solid = 0;
  ColorNumbers solid, liquid, ground, background;
  double shininess = 1, specular = 0, metallic = 0;
  bool glows = false;
  double glow_cold = 0, glow_hot = 0;
  std::vector<ColorNumbers> materials;
  ColorNumbers clear;
  double frost = 0;
  double light_x = 0, light_y = 0, light_z = 0, ambient = 0;
  double target_x = 0, target_y = 0, target_z = 0;
  double azimuth = 0, elevation = 0, distance = 0, field_of_view = 0;
  Int width = 0, height = 0;
  bool orthographic = false;
  bool has_terrain = false, textured = false;
  std::string setting;
  Ints mask, amount, heat;      // index (z ny + y) nx + x
  Ints material;                // the same; empty without colours of materials
  std::vector<double> terrain;  // index z nx + x

  Int cell(Int x, Int y, Int z) const { return (z * ny + y) * nx + x; }
  Int column(Int x, Int z) const { return z * nx + x; }
};

// The function strtod reads a decimal double back exactly.
inline double number_from(std::istream& words) {
  std::string word;
  if (!(words >> word)) throw std::runtime_error("a number is missing");
  return std::strtod(word.c_str(), nullptr);
}
inline Int integer_from(std::istream& words) {
  std::string word;
  if (!(words >> word)) throw std::runtime_error("an integer is missing");
  return std::stoll(word);
}
inline ColorNumbers color_from(std::istream& words) {
  ColorNumbers c;
  c.red = number_from(words);
  c.green = number_from(words);
  c.blue = number_from(words);
  return c;
}

inline void read_line_of(Input& in, const std::string& line) {
  std::istringstream words(line);
  std::string name;
  words >> name;
  if (name == "voxmelt-picture") {
    if (integer_from(words) != 1) throw std::runtime_error("unknown version");
  } else if (name == "grid") {
    in.nx = integer_from(words);
    in.ny = integer_from(words);
    in.nz = integer_from(words);
  } else if (name == "smooth") {
    in.smooth = integer_from(words);
    in.smooth_solid = integer_from(words);
  } else if (name == "solid")
    in.solid = color_from(words);
  else if (name == "liquid")
    in.liquid = color_from(words);
  else if (name == "ground")
    in.ground = color_from(words);
  else if (name == "background")
    in.background = color_from(words);
  else if (name == "shininess")
    in.shininess = number_from(words);
  else if (name == "specular")
    in.specular = number_from(words);
  else if (name == "metallic")
    in.metallic = number_from(words);
  else if (name == "glow") {
    in.glows = integer_from(words) != 0;
    in.glow_cold = number_from(words);
    in.glow_hot = number_from(words);
  } else if (name == "clear") {
    in.clear = color_from(words);
    in.frost = number_from(words);
  } else if (name == "material") {
    in.materials.push_back(color_from(words));
  } else if (name == "light") {
    in.light_x = number_from(words);
    in.light_y = number_from(words);
    in.light_z = number_from(words);
    in.ambient = number_from(words);
  } else if (name == "camera") {
    in.target_x = number_from(words);
    in.target_y = number_from(words);
    in.target_z = number_from(words);
    in.azimuth = number_from(words);
    in.elevation = number_from(words);
    in.distance = number_from(words);
    in.field_of_view = number_from(words);
    in.width = integer_from(words);
    in.height = integer_from(words);
  } else if (name == "orthographic") {
    in.orthographic = true;
  } else if (name == "terrain") {
    in.has_terrain = integer_from(words) != 0;
    in.textured = integer_from(words) != 0;
  } else if (name == "setting")
    words >> in.setting;
  else
    throw std::runtime_error("unknown line: " + line);
}

inline Input read_input(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot open " + path);
  const std::string all{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  Input in;
  std::size_t place = 0;
  for (;;) {
    const std::size_t end = all.find('\n', place);
    if (end == std::string::npos) throw std::runtime_error("no data");
    const std::string line = all.substr(place, end - place);
    place = end + 1;
    if (line == "data") break;
    read_line_of(in, line);
  }
  const std::size_t cells = static_cast<std::size_t>(in.nx * in.ny * in.nz);
  const std::size_t columns = static_cast<std::size_t>(in.nx * in.nz);
  const std::size_t needed = cells * (in.materials.empty() ? 5 : 6) + (in.has_terrain ? columns * 4 : 0);
  if (all.size() - place != needed) throw std::runtime_error("the data has another length");
  const auto byte = [&all](std::size_t i) { return static_cast<Int>(static_cast<unsigned char>(all[i])); };
  for (std::size_t i = 0; i < cells; ++i) in.mask.push_back(byte(place + i));
  place += cells;
  for (std::size_t i = 0; i < cells; ++i)
    in.amount.push_back(byte(place + 2 * i) + 256 * byte(place + 2 * i + 1));
  place += 2 * cells;
  for (std::size_t i = 0; i < cells; ++i)
    in.heat.push_back(byte(place + 2 * i) + 256 * byte(place + 2 * i + 1));
  place += 2 * cells;
  if (!in.materials.empty()) {
    for (std::size_t i = 0; i < cells; ++i) in.material.push_back(byte(place + i));
    place += cells;
  }
  if (in.has_terrain) {
    for (std::size_t i = 0; i < columns; ++i) {
      float height = 0;
      std::memcpy(&height, all.data() + place + 4 * i, 4);
      in.terrain.push_back(static_cast<double>(height));
    }
  }
  return in;
}
