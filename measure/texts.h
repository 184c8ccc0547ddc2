// The functions here write numbers for tables.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace voxmelt::measure {

std::string size_text(std::size_t bytes);                         // "2 MiB"
std::string three_digits(double value);                           // "1.23", "0.034", "1234"
std::string or_dash(const std::optional<double>& value);          // three digits, or a dash
std::string percent_or_dash(const std::optional<double>& value);  // "12 %", or a dash
std::string milliseconds(double seconds);                         // three digits
std::string threads_text(int threads);                            // "1 thread", "2 threads"

// Warns if other work takes a quarter of the processors or more; else it is empty. `load` is the load
// average, of which `own` threads are ours.
std::string busy_text(double load, int own, int processors);

}  // namespace voxmelt::measure
