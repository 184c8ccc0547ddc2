// Standard output and standard error are written so that nothing is thrown. A reader that has gone and a disk
// that is full must not end a run. A loss on standard output is noticed at the end (standard_output_is_well).
// A message that nobody can read is lost.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace voxmelt::app {

void put(std::string_view text);        // to standard output, some time later
void put_error(std::string_view text);  // to standard error, at once
int output_error();                     // errno of the first failure of standard output; 0: none

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  put(fmt::format(format, std::forward<Values>(values)...));
}
template <class... Values>
void print_error(fmt::format_string<Values...> format, Values&&... values) {
  put_error(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace voxmelt::app
