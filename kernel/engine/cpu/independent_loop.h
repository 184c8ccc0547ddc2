// A word before a loop, for compilers: no iteration depends on another.
#pragma once

#if defined(__clang__)
#define VOXMELT_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define VOXMELT_INDEPENDENT _Pragma("GCC ivdep")
#endif
