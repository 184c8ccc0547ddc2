// The field lies in arrays with a rim of RIM cells on every side, x fastest: as far as the filter can reach from the
// grid (docs/picture/field.md, section 6). Columns are numbered z NX + x.
#define RIM 6
#define WIDE (NX + 2 * RIM)
#define HIGH (NY + 2 * RIM)
#define DEEP (NZ + 2 * RIM)
#define PLACES (WIDE * HIGH * DEEP)
#define COLUMNS_OF_ALL (NX * NZ)

// The channels come one after the other. The heat is the last, as not every scene has it.
#define INTENSITY 0
#define SOLID_PART 1
#define LIQUID_PART 2
#define OBSTACLE_PART 3
#define HEAT_PART 4

#define FULL_INTENSITY 65280

FN int place_at(CONSTANTS, int x, int y, int z) { return ((z + RIM) * HIGH + y + RIM) * WIDE + x + RIM; }
FN GLOBAL ushort* channel_of(CONSTANTS, GLOBAL ushort* all, int channel) { return all + (ulong)channel * (ulong)PLACES; }

FN int intensity_of(int amount) { return 16 * amount - ((amount + 15) >> 4); }

// Visits all places, the grid's and those of the rim, with x, y, z counted from the grid's first cell.
#define FOR_PLACES(n) for (int n = GROUP * LANES + LANE; n < PLACES; n += GROUPS * LANES)
#define PLACE_OF(n) int x = n % WIDE - RIM, y = n / WIDE % HIGH - RIM, z = n / (WIDE * HIGH) - RIM;
#define FOR_COLUMNS(n) for (int n = GROUP * LANES + LANE; n < COLUMNS_OF_ALL; n += GROUPS * LANES)
