// VOXMELT_INDEPENDENT stands before a loop and tells g++ that no iteration depends on another. The compiler
// clang looks for itself at run time. Its own word for it warns if a loop does not become vectors.
#pragma once

#if defined(__clang__)
#define VOXMELT_INDEPENDENT
#else
#define VOXMELT_INDEPENDENT _Pragma("GCC ivdep")
#endif
