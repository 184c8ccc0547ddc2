// The time of a run goes to the phases of its steps, and to visibility before them.
#pragma once

#include <array>
#include <string_view>

namespace voxmelt::state {

struct Seconds {
  double source = 0, heat = 0, melt = 0, gravity = 0, spread = 0, excess = 0;
  double visibility = 0;

  struct Row {
    std::string_view name;  // name in reports
    double Seconds::*value;
  };
  // The rows are the phases in the order of step::Phase, then visibility. They stand in a checkpoint in this
  // order, too.
  static constexpr std::array<Row, 7> table() {
    return {{{"source", &Seconds::source},
             {"heat", &Seconds::heat},
             {"melt", &Seconds::melt},
             {"gravity", &Seconds::gravity},
             {"spread", &Seconds::spread},
             {"excess", &Seconds::excess},
             {"visibility", &Seconds::visibility}}};
  }

  double total() const {
    double sum = 0;
    for (const Row& row : table()) sum += this->*row.value;
    return sum;
  }
  friend bool operator==(const Seconds&, const Seconds&) = default;
};
static_assert(sizeof(Seconds) == Seconds::table().size() * sizeof(double), "a time without a row");

}  // namespace voxmelt::state
