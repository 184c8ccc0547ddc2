// CUDA C++. A group has 32 x 4 items: a warp is a row.
typedef unsigned char uchar;
typedef unsigned short ushort;
typedef unsigned int uint;
typedef unsigned long ulong;
#define KERNEL(name) extern "C" __global__ __launch_bounds__(128) void name
#define GLOBAL
#define LOCAL
#define SHARED __shared__
#define PRIVATE
#define FN static __device__
#define TABLE static __constant__ const
#define LANES_X 32
#define LANES_Y 4
#define LANES 128
#define LANE_X ((int)threadIdx.x)
#define LANE_Y ((int)threadIdx.y)
#define LANE (LANE_Y * LANES_X + LANE_X)
#define GROUP ((int)blockIdx.x)
#define GROUPS ((int)gridDim.x)
#define BARRIER __syncthreads()
#define SCRATCH __shared__ long scratch[LANES];
#define NEXT(counter) atomicAdd(counter, 1)
#define RAISE_TO(number, least) atomicMax(number, least)
#define LOOK(flag) (flag)
#define STAMP(moment, now) ((moment) = (now))
#define CLAIM(moment, now) atomicExch(moment, now)
#define MUL_HIGH(a, b) __umul64hi(a, b)
#define LEADING_ZEROS(a) __clzll((long long)(a))
