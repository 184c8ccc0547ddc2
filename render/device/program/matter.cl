// What each cell contributes before the filter (docs/picture/field.md, sections 2 and 5).
#define SHOWS_HEAT 1  // what the last channel holds: heat of liquid, or the tone of solids
#define SHOWS_TONES 2

KERNEL(put_matter)(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL const ushort* H,
                   GLOBAL const int* columns, GLOBAL const int* tones, int shows, GLOBAL ushort* all) {
  GLOBAL ushort* intensity = channel_of(P, all, INTENSITY);
  GLOBAL ushort* solid = channel_of(P, all, SOLID_PART);
  GLOBAL ushort* liquid = channel_of(P, all, LIQUID_PART);
  GLOBAL ushort* obstacle = channel_of(P, all, OBSTACLE_PART);
  GLOBAL ushort* heat = channel_of(P, all, HEAT_PART);
  for (int m = GROUP * LANES + LANE; m < NX * NY * NZ; m += GROUPS * LANES) {
    int x = m % NX, y = m / NX % NY, z = m / (NX * NY), n = z * NX + x;
    int i = cell_at(P, x, y, z), p = place_at(P, x, y, z);
    uint f = F[i];
    int is_solid = (f & SOLID) != 0u, value = intensity_of(part_of_cell(f, A[i]));
    int block = (f & INERT) != 0u && y >= COLUMN_NUMBER(BED);
    intensity[p] = (ushort)(block ? FULL_INTENSITY : value);
    solid[p] = (ushort)(is_solid ? value : 0);
    liquid[p] = (ushort)(is_solid ? 0 : value);
    obstacle[p] = (ushort)(block ? FULL_INTENSITY : 0);
    if (shows == SHOWS_HEAT) heat[p] = (ushort)(is_solid ? 0u : ((uint)value * H[i]) >> 16);
    if (shows == SHOWS_TONES)
      heat[p] = (ushort)(is_solid ? (value * tones[f >> MATERIAL_SHIFT] + 255) >> 8 : 0);
  }
}

// Moves the puddle from `floor_` to `end` of column n by `way`.
FN void move_puddle(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL ushort* intensity, int n,
                    int floor_, int end, int way) {
  int x = n % NX, z = n / NX, first = cell_at(P, x, 0, z), at = place_at(P, x, 0, z);
  int s = iclamp(way, -ONE, ONE), part = s < 0 ? -s : s;
  for (int y = s < 0 ? floor_ - 1 : floor_; y <= imin(end, NY - 1); ++y) {
    int beside = s < 0 ? y + 1 : y - 1;
    int here = y < floor_ ? ONE : y < end ? imin(A[first + y * ROW], ONE) : 0;
    int there = beside < floor_ ? ONE : beside < end ? imin(A[first + beside * ROW], ONE) : 0;
    int p = at + y * WIDE;
    if (y == end && intensity[p] != 0) continue;
    intensity[p] = (ushort)intensity_of((here * (ONE - part) + there * part) >> 12);
  }
}

// Fills the ground below and beside matter, and moves puddles. `levels` are those after all passes.
KERNEL(fill_columns)(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL const int* columns,
                     GLOBAL const int* levels, int smooth, GLOBAL ushort* all) {
  GLOBAL ushort* intensity = channel_of(P, all, INTENSITY);
  FOR_COLUMNS(n) {
    int x = n % NX, z = n / NX;
    int bed = COLUMN_NUMBER(BED), floor_ = COLUMN_NUMBER(FLOOR_OF), end = COLUMN_NUMBER(END_OF);
    int shift = 0, level = COLUMN_NUMBER(LEVEL_OF);
    if (smooth && level != NO_LEVEL) {
      int most = imin(MOST_SHIFT, COLUMN_NUMBER(DEPTH_OF) >> 1);
      shift = iclamp((levels[n] >> 4) - level, -most, most);
    }
    if (floor_ > bed && end > floor_ && shift != 0) move_puddle(P, F, A, intensity, n, floor_, end, shift);
    if (bed == 0) continue;
    int distance = 3;
    for (int dz = -2; dz <= 2; ++dz)
      for (int dx = -2; dx <= 2; ++dx) {
        int ox = x + dx, oz = z + dz;
        if (ox < 0 || oz < 0 || ox >= NX || oz >= NZ) continue;
        if (columns[WET * COLUMNS_OF_ALL + oz * NX + ox] == 0) continue;
        distance = imin(distance, imax(dx < 0 ? -dx : dx, dz < 0 ? -dz : dz));
      }
    if (distance > 2) continue;
    int sink = distance == 2 ? ONE : 1638 - 1638 * COLUMN_NUMBER(WET) / ONE;
    int rise = COLUMN_NUMBER(OFFSET_OF) - sink, at = place_at(P, x, 0, z);
    if (bed < NY && (F[cell_at(P, x, bed, z)] & INERT) != 0u) rise = imax(rise, 0);
    for (int y = 0; y <= imin(bed, NY - 1); ++y) {
      int filled = intensity_of(iclamp((bed - y) * ONE + rise, 0, ONE));
      if (filled > intensity[at + y * WIDE]) intensity[at + y * WIDE] = (ushort)filled;
    }
    if (floor_ == bed && end > floor_) move_puddle(P, F, A, intensity, n, floor_, end, rise + shift);
  }
}
