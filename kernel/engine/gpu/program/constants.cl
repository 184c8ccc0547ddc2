// The numbers of a scene that kernels read. A program for one scene has them as constants (SPECIALISED, with
// -D NAME=value). A program for any scene reads them from memory. constants.cpp gives each a value by its name.
#ifndef SPECIALISED
#define NX ((int)P[0])
#define NY ((int)P[1])
#define NZ ((int)P[2])
#define ROW ((int)P[3])
#define SLICE ((int)P[4])
#define FIRST ((int)P[5])
#define CELLS ((int)P[6])
#define BRICKS_X ((int)P[7])
#define BRICKS_Y ((int)P[8])
#define BRICKS_Z ((int)P[9])
#define PAPER ((int)P[10])
#define HEAT ((int)P[11])
#define MATERIALS ((int)P[12])
#define MELTING_POINT ((int)P[13])
#define LATENT_HEAT ((int)P[14])
#define FREEZING_POINT ((int)P[15])
#define TOP ((int)P[16])
#define WALLS ((int)P[17])
#define CONVECTION ((int)P[18])
#define AIR ((int)P[19])
#define AIR_EXCHANGE ((int)P[20])
#define AIR_GLOW ((int)P[21])
#define AIR_SKY ((int)P[22])
#define FACTOR ((int)P[23])
#define WALL_FACTOR ((int)P[24])
#define MINIMUM ((int)P[25])
#define HANG ((int)P[26])
#define SEES_SIDES ((int)P[27])
#define NEIGHBOURS ((int)P[28])
#define THRESHOLD ((int)P[29])
#define USE_TABLE ((int)P[30])
#define SHARE ((int)P[31])
#define DOWNHILL ((int)P[32])
#define MARGIN ((int)P[33])
#define SUPPORT ((int)P[34])
#define SLUMP ((int)P[35])
#define PRINTED ((int)P[36])
#define BETA ((int)P[37])
#define ALPHA_LIQUID ((int)P[38])
#define ALPHA_SOLID ((int)P[39])
#define ALPHA_FLOOR ((int)P[40])
#define REHEAT ((int)P[41])
#define MOBILITY ((long)P[42])
#define YIELD ((int)P[43])
#define STIFFNESS ((int)P[44])
#define THERMAL ((int)P[45])
#define MOBILITY_REFERENCE ((int)P[46])
#define MOBILITY_RATE ((int)P[47])
#define RAY_SIDE ((int)P[48])
#define KINDS ((int)P[49])
#endif

// Numbers in tables: where each begins.
#define KEYS 0                // of random bits
#define MATERIAL_ROWS 16      // of 12 numbers
#define MATERIAL_ROW 12
#define WEIGHTS 208           // [faces, edges, corners][16][16]
#define PATTERN_TABLE 976     // [16][4]
#define MOBILITY_TABLE 1040   // [32]
#define RAY_KEYS 1072         // of the random bits of rays
#define AIR_TEMPERATURES 1088 // [NY]
