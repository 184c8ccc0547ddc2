// The look of a scene is plain data, read by render/. Lengths are in cells, colours in linear RGB 0..1.
#pragma once

#include <array>
#include <vector>

namespace voxmelt::scene {

using Vec3 = std::array<double, 3>;

inline constexpr int kWidestPicture = 16384;  // pixels, across and down

struct Camera {
  Vec3 target{};              // place looked at
  double azimuth = 35;        // degrees, 0 looks along -z from +z, 90 looks along -x from +x
  double elevation = 28;      // degrees above the horizon
  double distance = 0;        // from the target; 0: chosen so that the grid fits
  double field_of_view = 30;  // degrees, vertical
  bool orthographic = false;  // rays are parallel: the picture is as high as it would be at the target
  int width = 640, height = 480;
};

struct Light {
  Vec3 direction{-0.5, 0.8, 0.6};  // towards the light
  double ambient = 0.35;

  friend bool operator==(const Light&, const Light&) = default;
};

inline constexpr int kMostSmooth = 6;  // passes that the renderer can do

struct Look {
  Vec3 solid{0.55, 0.56, 0.6};   // colour of matter that has not melted
  std::vector<Vec3> materials;   // the same for each material of solids; none: there is one material
  Vec3 liquid{0.78, 0.8, 0.84};  // colour of matter that flows
  Vec3 ground{0.42, 0.36, 0.3};  // floor and terrain
  Vec3 background{0.93, 0.94, 0.96};
  double shininess = 40;  // Blinn-Phong exponent
  double specular = 0.4;
  double metallic = 0;  // 0: wax, chocolate, plastic; 1: bare metal that mirrors its surroundings
  bool glow = false;    // colour and light of the liquid by its temperature (lava)
  // Holds the cells of matter through which half of the red, green and blue passes. Less than 1 counts as 1.
  // If all are 0, matter is opaque.
  Vec3 clear{};
  double frost = 0.1;                       // share of the light that a surface of clear matter scatters
  double glow_cold = 0.3, glow_hot = 0.95;  // temperatures at the ends of the glow ramp, 0..1
  int smooth = 3, smooth_solid = 1;  // low-pass of liquid and of solid: passes of the 3x3x3 binomial filter

  friend bool operator==(const Look&, const Look&) = default;
};

}  // namespace voxmelt::scene
