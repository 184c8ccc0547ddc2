// The pages of `voxmelt verify` are made of these parts. A page is drawn from the JSON report alone, and
// every number that is written on it stands there. Only the marks along an axis (class "tick") do not.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voxmelt::hwmodel::parts {

using Json = nlohmann::ordered_json;

extern const char* const kStyle;  // beside the style sheet of all pages

std::string number(const Json& value, int digits = 2);  // "854,688", "0.93"; digits behind the point of reals

std::string tally(const std::string& number, const std::string& what, const char* css = "");
// Makes a card. `title` and `about` are HTML.
std::string card(const std::string& title, const std::string& about, const std::string& body);

struct Key {
  std::string css, name;  // `css` colours it
};
std::string legend(const std::vector<Key>& keys);
// Returns the classes of a stage's cycles that a report has, in the order in which they are drawn.
std::vector<Key> classes_of(const Json& cycles);

// Horizontal bars lie one below the other, on one scale.
struct Segment {
  double value = 0;
  std::string css, hover;
};
struct Bar {
  std::string name, value;  // on its left and right
  std::vector<Segment> segments;
};
std::string bars(const std::vector<Bar>& rows, const std::string& label);
std::string bars_of_cycles(const Json& stages);  // with "name", maybe "cascade", and "cycles"

std::string name_of_stage(const Json& stage, bool cascaded);
bool cascaded(const Json& stages);  // tells if there are several time steps

// Draws the `timeline` of the report, stacked over time.
std::string timeline(const Json& timeline);
// Shows how often a channel held how many tokens.
std::string histogram(const Json& channel);
// Holds work a cycle against the bytes that a memory moves in a cycle, and the bounds.
struct Roof {
  std::string caption, unit;  // counted unit: "cell-steps"
  Json compute, per_byte;     // most work in a cycle; work per byte that moves
  struct Bound {
    Json value;
    std::string name;
  };
  std::vector<Bound> bounds;  // each below the one before
  struct Reached {
    Json rate, bytes;  // a cycle
    std::string name;
  };
  std::vector<Reached> reached;
  Json most_bytes{};  // most bytes of the memory in a cycle; null: it is not drawn
};
std::string roofline(const Roof& roof);
// Draws simulated against predicted cycles, each with "cycles" and "predicted_cycles", and its hover text.
std::string against_prediction(const Json& trains, const std::vector<std::string>& hover);

}  // namespace voxmelt::hwmodel::parts
