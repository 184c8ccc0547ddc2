// The guard looks at a document before the TOML parser does. Text that would crash the parser is an error
// with its place.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace voxmelt::scene {

inline constexpr std::size_t kDeepestKey = 64;      // parts of a dotted key
inline constexpr std::size_t kDeepestBracket = 64;  // arrays and inline tables within each other

// Tells what is wrong, and where it stands (line and column from 1, in bytes). An empty text means nothing.
struct Objection {
  std::string text;
  std::size_t line = 0, column = 0;
};

// Looks for text that the parser does not bear. The parser recurses once per part of a key and once per
// bracket. It reads beyond its tables on letters outside ASCII that are not quoted. It stops the program at a
// table's header that ends with its line.
Objection object_to(std::string_view document);

}  // namespace voxmelt::scene
