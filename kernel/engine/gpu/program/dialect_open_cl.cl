// OpenCL C 1.2. A group has 32 x 4 items.
#define KERNEL(name) __kernel __attribute__((reqd_work_group_size(32, 4, 1))) void name
#define GLOBAL __global
#define LOCAL __local
#define SHARED __local
#define PRIVATE __private
#define FN static
#define TABLE __constant
#define LANES_X 32
#define LANES_Y 4
#define LANES 128
#define LANE_X ((int)get_local_id(0))
#define LANE_Y ((int)get_local_id(1))
#define LANE (LANE_Y * LANES_X + LANE_X)
#define GROUP ((int)get_group_id(0))
#define GROUPS ((int)get_num_groups(0))
#define BARRIER barrier(CLK_LOCAL_MEM_FENCE)
#define SCRATCH __local long scratch[LANES];
#define NEXT(counter) atomic_inc(counter)
#define RAISE_TO(number, least) atomic_max(number, least)
#define LOOK(flag) (flag)
#define STAMP(moment, now) ((moment) = (now))
#define CLAIM(moment, now) atomic_xchg(moment, now)
#define MUL_HIGH(a, b) mul_hi(a, b)
#define LEADING_ZEROS(a) ((int)clz(a))
