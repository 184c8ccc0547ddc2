// The fields of a state as columns of bytes, for the writers of files.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/run/io/export.h"

namespace voxmelt::io {

// Tells the name of a field in the files, and writes one row of it.
struct Column {
  std::string name;
  const char* npy_type;
  const char* vtk_type;
  std::size_t bytes;  // bytes of a cell
  std::function<void(std::string& rows, int y, int z)> append_row;
};

// Returns the columns of a volume. Masks have a byte for each cell.
std::vector<Column> columns_of(const state::Volume& volume);

// Gives all rows to `take`, some at a time, so that an export takes no memory to speak of beside the state.
void for_each_piece(const Column& column, state::Grid grid, const Poll& poll,
                    const std::function<void(std::string_view)>& take);

// Returns what stands before the numbers in an npy file of this column.
std::string npy_header(const Column& column, state::Grid grid);

}  // namespace voxmelt::io
