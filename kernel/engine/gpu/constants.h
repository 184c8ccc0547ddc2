// The numbers of a scene, as kernels read them (program/constants.cl).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/engine/gpu/shape.h"

namespace voxmelt::gpu {

struct Constants {
  std::vector<std::int64_t> numbers;  // in the order of program/constants.cl
  std::vector<std::int32_t> tables;
};

Constants constants_of(const rule::Parameters& parameters, const Shape& shape);

// Returns a bit for each kind of source, by the number of its row in rule::kSourceKinds. program/light.cl
// numbers them in the same way.
std::int32_t source_kinds(const rule::Heat& heat);

// Returns the options that make a program for these numbers alone: -D NX=64 and so on.
std::string specialised_options(const Constants& constants);

// Returns the numbers of a shape alone, and such options for a program that reads no others.
std::vector<std::int64_t> shape_numbers(const Shape& shape);
std::string specialised_options(const Shape& shape);

}  // namespace voxmelt::gpu
