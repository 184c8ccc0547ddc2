// The picture's program, in the order in which its parts build on each other. The state's layout is the stepper's.
#include "kernel/engine/gpu/program/constants.cl"
#include "kernel/engine/gpu/program/cells.cl"
#include "render/device/program/lattice.cl"
#include "render/device/program/columns.cl"
#include "render/device/program/matter.cl"
#include "render/device/program/filter.cl"
