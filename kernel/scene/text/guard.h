// Looks at a document before the TOML parser does: what would crash the parser is an error with its place.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace voxmelt::scene {

inline constexpr std::size_t kDeepestKey = 64;      // parts of a dotted key
inline constexpr std::size_t kDeepestBracket = 64;  // arrays and inline tables within each other

// What is wrong, and where it stands (line and column from 1, in bytes); an empty text: nothing.
struct Objection {
  std::string text;
  std::size_t line = 0, column = 0;
};

// The parser recurses once per part of a key and once per bracket; it reads beyond its tables on letters
// outside ASCII that are not quoted, and stops the program at a table's header that ends with its line.
Objection object_to(std::string_view document);

}  // namespace voxmelt::scene
