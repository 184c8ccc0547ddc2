// Read before all that Verilator writes: its fatal messages name no path of the tree that a program was
// built in.
#pragma once

#include <verilated.h>

#ifndef VOXMELT_VERILATED  // set for Verilator's own sources, which define it
#define VL_FATAL_MT(file, line, hierarchy, message) VL_FATAL_MT("", line, hierarchy, message)
#endif
