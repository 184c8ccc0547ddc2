// Faults of the ray caster strike in these pictures: some are hostile, and some are made for a fault.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/caster/model/configuration.h"
#include "tests/kernel/worlds.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt::hwmodel::raycast::fault_pictures {

struct Case {
  test::HostilePicture picture;
  Configuration configuration;
};

inline void put_solid(state::Volume& volume, int x, int y, int z, int amount) {
  volume.solid.set(x, y, z, true);
  volume.amount[volume.at(x, y, z)] = static_cast<std::uint16_t>(amount);
}

// Makes a wall whose surface lies just inside of the blocks of four places. Cell c is place c + 2, so the
// places 8 and 16 are borders of blocks. The cells there decide how near the surface comes.
// With corners, those cells hold something else in each block. Then in some blocks the first sample beyond
// the border is in matter. Without corners, no block sticks out of the box of occupied cells.
inline Case wall_at_border(int seed, bool corners) {
  Case one;
  one.picture.volume = state::Volume(state::Grid{24, 24, 24});
  worlds::for_each({6, 0, 0, 15, 24, 24}, [&](int x, int y, int z) {
    const int any = corners ? ((y + 2) / 4 * 7 + (z + 2) / 4 + 9 * seed) % 40 * 100 : 2030;
    put_solid(one.picture.volume, x, y, z, x == 6 || x == 14 ? any : 4096);
  });
  if (corners)  // the box of occupied cells is nearly the grid, and rays leave empty blocks
    for (const int at : {0, 20})
      worlds::for_each({at, at, at, at + 4, at + 4, at + 4},
                       [&](int x, int y, int z) { put_solid(one.picture.volume, x, y, z, 4096); });
  one.picture.look.smooth = one.picture.look.smooth_solid = 0;
  one.picture.camera.azimuth = seed % 2 == 0 ? 90 : -90;
  one.picture.camera.elevation = 3 * seed;
  one.picture.camera.target = {12, 12, 12};
  one.picture.camera.width = one.picture.camera.height = corners ? 40 : 16;
  return one;
}

// Makes a wide plate seen from above. Its lines are so small that their numbers exceed 4096, and a cache
// keeps them.
inline Case wide_plate(int seed) {
  Case one;
  one.picture.volume = state::Volume(state::Grid{72, 10, 72});
  worlds::for_each({2, 3, 2, 70, 7, 70}, [&](int x, int y, int z) {
    put_solid(one.picture.volume, x, y, z, 4096 - 300 * ((x + 2 * z) % 5));
  });
  one.picture.camera.elevation = 85 - 10 * seed;
  one.picture.camera.target = {36, 5, 36};
  one.picture.camera.width = one.picture.camera.height = 48;
  one.configuration.level_bits = 1;
  one.configuration.levels = {1024, 8, 16, 64};
  return one;
}

// Makes a slope that is seen straight along the diagonal of the grid. There a level rises nearly as fast as
// its bound allows: a leap of two samples ends in matter, right behind the surface. With 27 pixels a step is
// nearly as long as it may be: 32 x 27 x 9459 is 0.97 of a power of two, and 9459 is 2^14 over the root of 3.
inline Case slope_seen_along_the_diagonal(int seed) {
  Case one;
  one.picture.volume = state::Volume(state::Grid{24, 24, 24});
  worlds::for_each(worlds::whole(one.picture.volume.grid), [&](int x, int y, int z) {
    const int depth = 410 + 2 * seed - 10 * (x + y + z);  // 152 of them are a full cell
    if (depth > 0) put_solid(one.picture.volume, x, y, z, std::min(4096, 4096 * depth / 152));
  });
  one.picture.camera.azimuth = 45;
  one.picture.camera.elevation = 33.5;  // a little less than the diagonal's: rays meet it between samples
  one.picture.camera.field_of_view = 2;
  one.picture.camera.target = {11, 11, 11};
  one.picture.camera.width = one.picture.camera.height = 27;
  return one;
}

struct Made {
  std::string name;
  Case picture;
};
// Makes the pictures for those faults that hardly ever make a difference in others.
inline std::vector<Made> made_for(Fault fault) {
  std::vector<Made> all;
  for (int seed = 0; seed < 12; ++seed) {
    const std::string number = ' ' + std::to_string(seed);
    if (fault == Fault::walk_box) all.push_back({"wall" + number, wall_at_border(seed, false)});
    if (fault == Fault::walk_block) all.push_back({"wall and corners" + number, wall_at_border(seed, true)});
    if (fault == Fault::crossing_stale)
      all.push_back({"slope" + number, slope_seen_along_the_diagonal(seed)});
    if (fault == Fault::cache_tag_bits && seed < 4) all.push_back({"plate" + number, wide_plate(seed)});
  }
  return all;
}

inline bool is_of_clear_matter(Fault fault) {
  return fault >= Fault::stretch_way && fault <= Fault::press_nothing;
}

// Makes a hostile clear picture. Every second one has no obstacles.
inline test::HostilePicture hostile_clear(std::uint64_t seed) {
  test::HostilePicture picture = test::hostile_clear_picture(seed, 3000);
  if (seed % 2 == 1) return picture;
  worlds::for_each(worlds::whole(picture.volume.grid), [&](int x, int y, int z) {
    if (picture.volume.inert.test(x, y, z)) {
      picture.volume.solid.set(x, y, z, true);
      picture.volume.inert.set(x, y, z, false);
    }
  });
  picture.terrain = {};
  picture.look.frost = 0.1;
  return picture;
}

inline Case hostile(int seed, bool clear) {
  const auto number = static_cast<std::uint64_t>(seed);
  Case one{clear ? hostile_clear(number) : test::hostile_picture(number, 3000), {}};
  worlds::Random random(static_cast<std::uint64_t>(seed) + 77);
  if (!clear) one.picture.look.clear = {};
  Configuration& c = one.configuration;
  c.pipes = random.any({1, 2});
  c.stall_seed = random.one_in(2) ? 0 : static_cast<std::uint64_t>(seed) + 1;
  c.fifo_depth = random.any({2, 4});
  c.levels = {random.any({1, 4}), random.any({1, 2, 4}), 8, 64};
  c.level_bits = random.between(1, 3);
  c.apron = random.one_in(3);
  if (one.picture.camera.width * one.picture.camera.height > 500)
    one.picture.camera.width = one.picture.camera.height = 20;
  one.picture.setting = render::Setting::normal;
  return one;
}

}  // namespace voxmelt::hwmodel::raycast::fault_pictures
