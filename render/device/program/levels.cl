// What rays read of the field: levels, shares of matter, and how far it is to the next matter.
#define AIR_LEVEL (-32640)

// The filter 1 4 1 along an axis. Beyond the grid the outermost cells repeat themselves (section 6). The last axis
// gives levels, which are those of air in the rim.
FN int prefiltered(GLOBAL const ushort* from, int n, int step, int at, int side) {
  return (43 * from[at > 0 ? n - step : n] + 170 * from[n] + 43 * from[at < side - 1 ? n + step : n] + 128) >> 8;
}
FN int in_grid(CONSTANTS, int x, int y, int z) {
  return x >= 0 && y >= 0 && z >= 0 && x < NX && y < NY && z < NZ;
}
KERNEL(prefilter_x)(CONSTANTS, GLOBAL const ushort* from, GLOBAL ushort* to) {
  FOR_PLACES(n) {
    PLACE_OF(n)
    if (in_grid(P, x, y, z)) to[n] = (ushort)prefiltered(from, n, 1, x, NX);
  }
}
KERNEL(prefilter_y)(CONSTANTS, GLOBAL const ushort* from, GLOBAL ushort* to) {
  FOR_PLACES(n) {
    PLACE_OF(n)
    if (in_grid(P, x, y, z)) to[n] = (ushort)prefiltered(from, n, WIDE, y, NY);
  }
}
KERNEL(make_levels)(CONSTANTS, GLOBAL const ushort* from, GLOBAL short* levels) {
  FOR_PLACES(n) {
    PLACE_OF(n)
    int level = AIR_LEVEL;
    if (in_grid(P, x, y, z)) level += prefiltered(from, n, WIDE * HIGH, z, NZ);
    levels[n] = (short)level;
  }
}

// What matter is made of (docs/picture/light.md, section 3).
FN int heat_share(PAINT, int liquid, int heat) {
  if (liquid == 0) return 0;
  int temperature = imin(heat * 256 / liquid, 256) * 256, range = imax(GLOW_HOT - GLOW_COLD, 1);
  return (int)lclamp((long)(temperature - GLOW_COLD) * 255 / range, 0, 255);
}

// The bytes liquid, heat or tone, and obstacle of each cell, from the lowest. A cell of air has none.
KERNEL(find_shares)(CONSTANTS, PAINT, GLOBAL const ushort* all, GLOBAL const short* levels, GLOBAL uint* shares) {
  GLOBAL const ushort* solids = all + (ulong)SOLID_PART * (ulong)PLACES;
  GLOBAL const ushort* liquids = all + (ulong)LIQUID_PART * (ulong)PLACES;
  GLOBAL const ushort* obstacles = all + (ulong)OBSTACLE_PART * (ulong)PLACES;
  GLOBAL const ushort* heats = all + (ulong)HEAT_PART * (ulong)PLACES;
  FOR_PLACES(n) {
    uint share = 0;
    if (levels[n] != AIR_LEVEL) {
      int solid = solids[n], liquid = liquids[n], obstacle = obstacles[n], matter = solid + liquid;
      if (matter > 0) share |= (uint)(liquid * 255 / matter);
      if (matter + obstacle > 0) share |= (uint)(obstacle * 255 / (matter + obstacle)) << 16;
      if (GLOWS) share |= (uint)heat_share(K, liquid, heats[n]) << 8;
      if (TINTED && solid > 0) share |= (uint)imin(heats[n] * 256 / solid, 255) << 8;
    }
    shares[n] = share;
  }
}

// Blocks of 4 x 4 x 4 cells, the first of which begins at cell -1. A byte tells how many blocks further the next one
// lies whose samples may be matter, along the axis where it is farthest. 0 is the block itself.
#define BLOCKS_X (NX / 4 + 1)
#define BLOCKS_Y (NY / 4 + 1)
#define BLOCKS_Z (NZ / 4 + 1)
#define FARTHEST 15

// Samples whose lower cell is in a block read the next cells, too. No sample is above the largest of its levels.
KERNEL(find_blocks)(CONSTANTS, GLOBAL const short* levels, GLOBAL uchar* blocks) {
  for (int n = GROUP * LANES + LANE; n < BLOCKS_X * BLOCKS_Y * BLOCKS_Z; n += GROUPS * LANES) {
    int x0 = n % BLOCKS_X * 4 - 1, y0 = n / BLOCKS_X % BLOCKS_Y * 4 - 1, z0 = n / (BLOCKS_X * BLOCKS_Y) * 4 - 1;
    int any = 0;
    for (int z = 0; z <= 4; ++z)
      for (int y = 0; y <= 4; ++y)
        for (int x = 0; x <= 4; ++x) any |= levels[place_at(P, x0 + x, y0 + y, z0 + z)] >= 0;
    blocks[n] = (uchar)(any ? 0 : FARTHEST);
  }
}

KERNEL(spread_blocks)(CONSTANTS, GLOBAL const uchar* from, GLOBAL uchar* to, int axis) {
  int step = axis == 0 ? 1 : axis == 1 ? BLOCKS_X : BLOCKS_X * BLOCKS_Y;
  int side = axis == 0 ? BLOCKS_X : axis == 1 ? BLOCKS_Y : BLOCKS_Z;
  for (int n = GROUP * LANES + LANE; n < BLOCKS_X * BLOCKS_Y * BLOCKS_Z; n += GROUPS * LANES) {
    int at = n / step % side, nearest = FARTHEST;
    for (int i = imax(0, at - FARTHEST); i <= imin(side - 1, at + FARTHEST); ++i)
      nearest = imin(nearest, imax(i < at ? at - i : i - at, from[n + (i - at) * step]));
    to[n] = (uchar)nearest;
  }
}
