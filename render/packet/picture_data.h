// Packets of rays read all of this, as plain data.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/packet/ground_data.h"
#include "render/rule/camera.h"
#include "render/rule/shade.h"
#include "render/rule/tone.h"

namespace voxmelt::render {

inline constexpr int kSlopeUnit = 768;  // unit of the slopes in FieldData::records, see field_bricks.h

// Bounds blocks of cells, from low to high (see field_bricks.h).
struct BlockBox {
  std::int32_t low[3], high[3];
};

inline constexpr int kLatticeBorder = 2;  // places before cell 0
inline constexpr int kBlockSide = 4;      // cells along a block, by which rays skip

// Returns where those samples begin whose lower cell lies in a block.
inline picture::Vector low_of_block(int x, int y, int z) {
  const auto axis = [](int b) {
    return (std::int64_t{b} * kBlockSide - kLatticeBorder) * picture::kCell - picture::kToPlace;
  };
  return {axis(x), axis(y), axis(z)};
}

struct FieldData {
  picture::Vector cells;
  std::int32_t bricks_x = 0, bricks_y = 0, blocks_x = 0, blocks_y = 0;
  const std::int32_t* slots = nullptr;  // see field_bricks.h
  const std::int16_t* levels = nullptr;
  const std::uint32_t* matter = nullptr;
  const std::int32_t* records = nullptr;
  bool obstacles = false;
  picture::Vector low, high;        // outside of this box there is air
  const BlockBox* shell = nullptr;  // boxes of FieldBricks::shell
  std::size_t shell_count = 0;
};

struct LightData {
  const std::uint8_t* cells = nullptr;  // 16 bytes each, see light_volume.h
  picture::Vector count;
  int shift = 1;
};

struct PictureData {
  picture::View view;
  std::int32_t width = 0, height = 0;  // pixels
  int spacing = 2;
  FieldData field;
  LightData light;
  GroundData ground;
  const picture::Paint* paint = nullptr;
  picture::Color background{};
  const std::uint32_t* inverse_root = nullptr;  // table of inverse_roots() in tables.h
  const picture::Tone* tone = nullptr;
  const picture::Bytes* bytes = nullptr;
  bool skip = true;  // leaves out samples that cannot matter; the picture is the same
};

// Holds the places that packets are asked for, in picture coordinates. There is room for kMostLanes more
// places, which hold any place that the data are made for. There is room for as much more light, too.
inline constexpr int kMostLanes = 16;
struct Places {
  const std::int32_t *across, *down;
  std::size_t count;
};

// Points to pressed light, red, green and blue, each 0 .. kLight.
struct PressedLight {
  std::uint16_t *red, *green, *blue;
};

// Points to the surfaces that rays meet. They have masks, positions in 2^-20 cells, and unit normals in
// 2^-14.
struct FoundSurface {
  std::int32_t* found;
  std::int32_t *position[3], *normal[3];
};

struct Packets {
  void (*draw)(const PictureData& data, Places places, PressedLight to);
  void (*find)(const PictureData& data, Places places, FoundSurface to);
  int lanes;
};

// Returns the packets, compiled for an architecture (packets_instance.cpp).
template <class Arch>
Packets packets_for();

}  // namespace voxmelt::render
