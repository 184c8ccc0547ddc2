// The dialect of the kernels for devices as C++20 (kernel/engine/gpu/program, render/device/program). It is
// included once, before the kernels, in an unnamed namespace of voxmelt. A group has one item.

#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

using uchar = unsigned char;
using ushort = unsigned short;
using uint = unsigned int;
using ulong = unsigned long;

__extension__ using Wide = unsigned __int128;
ulong mul_high(ulong a, ulong b) { return static_cast<ulong>(Wide{a} * b >> 64); }

#define KERNEL(name) void name
#define GLOBAL
#define LOCAL
#define SHARED
#define PRIVATE
#define FN inline
#define TABLE constexpr
#define LANES_X 1
#define LANES_Y 1
#define LANES 1
#define LANE_X 0
#define LANE_Y 0
#define LANE 0
#define GROUP gpu::place.group
#define GROUPS gpu::place.groups
#define BARRIER
#define SCRATCH long scratch[1];
#define NEXT(counter) gpu::next(*(counter))
#define RAISE_TO(number, least) gpu::raise_to(*(number), least)
#define LOOK(flag) gpu::look(flag)
#define STAMP(moment, now) gpu::stamp(moment, now)
#define CLAIM(moment, now) gpu::claim(*(moment), now)
#define MUL_HIGH(a, b) mul_high(a, b)
#define LEADING_ZEROS(a) gpu::leading_zeros(a)
