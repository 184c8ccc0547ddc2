// The header of NumPy's arrays is a dictionary as text.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace voxmelt::scene {

struct NpyHeader {
  std::string type;   // "<u2", "|b1", ">f8"
  std::string shape;  // "(2,3,4)", without blanks
  bool fortran_order = false;
  std::size_t bytes = 0;  // the numbers come behind them
};

// Reads the header, of each version of the format. `fail` is given a message, and throws.
NpyHeader read_npy_header(std::string_view bytes, const std::function<void(const std::string&)>& fail);

}  // namespace voxmelt::scene
