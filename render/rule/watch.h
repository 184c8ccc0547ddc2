// The rule tells its numbers to any watcher that wants to see them (render/reference/trace.h).
//
// A watcher is called as watcher(stage, name, value) once a number stands. Names are those of the pages. A
// value is an integer, an array of integers, a Vector, or something fetched.
#pragma once

#include <cstdint>

#include "render/rule/fixed_point.h"

namespace voxmelt::picture {

// Names the stages in the order of a ray. Each is a section of the pages.
enum class Stage : std::uint8_t {
  picture,   // numbers that all rays share: docs/picture/definition.md 3, docs/picture/light.md 1
  pixel,     // docs/picture/definition.md 10, docs/picture/light.md 7 and 8
  ray,       // docs/picture/definition.md 4 and 5
  brick,     // 12
  sample,    // 6; those of a crossing, too
  crossing,  // 7
  ground,    // docs/picture/ground.md 2 to 4
  met,       // docs/picture/definition.md 9
  unit,      // 8: a vector is brought to its length
  normal,    // 8
  paint,     // docs/picture/ground.md 5 and 8: the ground's normal and colour
  texture,   // 7 and 8
  matter,    // docs/picture/light.md 3
  light,     // 5
  arriving,  // 6
  material,  // 6
  mirror,    // 6
  colour,    // 6
  clear,     // docs/picture/translucent.md
};

// Ignores everything, because nobody listens.
struct Silent {
  template <class Value>
  [[gnu::always_inline]] constexpr void operator()(Stage, const char*, const Value&) const {}
};

// Holds the value that a memory gave for a cell.
template <class Value>
struct Fetched {
  Vector cell;
  Value value;
};
template <class Value>
Fetched(Vector, Value) -> Fetched<Value>;

// Wraps cells so that they tell what is read of them.
template <class Cells, class Watch>
struct Watched {
  const Cells& cells;
  Watch watch;
  Stage stage;

  [[gnu::always_inline]] constexpr auto operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const auto value = cells(x, y, z);
    watch(stage, "fetched", Fetched{Vector{x, y, z}, value});
    return value;
  }
  [[gnu::always_inline]] constexpr auto operator()(std::int64_t x, std::int64_t z) const {
    const auto value = cells(x, z);
    watch(stage, "fetched", Fetched{Vector{x, 0, z}, value});
    return value;
  }
};
template <class Cells, class Watch>
Watched(const Cells&, Watch, Stage) -> Watched<Cells, Watch>;

}  // namespace voxmelt::picture
