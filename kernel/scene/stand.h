// Says where a model comes to stand in the grid, and how large.
#pragma once

#include <filesystem>
#include <optional>

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/shape/geometry.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

inline constexpr double kLargestScale = 1e9;

// The middle of a model's underside comes to `at`.
struct Stand {
  Point at;
  double scale = 1;  // cells per unit of the file
};

// Reads `fit`, which makes a model as large as the grid has room for, and puts it into the middle. Nothing is
// returned if the key is missing. `box` holds the model. It throws InputError.
std::optional<Stand> read_fit(Reader& reader, const std::filesystem::path& file, const Box& box,
                              state::Grid grid);

// Returns the length of the file's unit in metres, or 1 if `unit` is missing.
double read_unit(Reader& reader);

}  // namespace voxmelt::scene
