// `voxmelt explore --compare A B` says what differs between two reports of explore.
#include <fmt/format.h>

#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/explore_command.h"
#include "app/message.h"
#include "app/print.h"

namespace voxmelt::app {
namespace {

using json = nlohmann::ordered_json;

// These parts hold the question, and then the answer. All others follow from them, or are times.
constexpr const char* kAsked[] = {"scene",     "grid",        "first_step", "steps",      "visibility_every",
                                  "device",    "memory",      "available",  "shell",      "lutram",
                                  "clock_mhz", "clock_range", "fill",       "fill_range", "family",
                                  "axes",      "dram"};
constexpr const char* kAnswered[] = {"best", "ranges", "next", "configurations"};

json read(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw UsageError(fmt::format("error: --compare {}: no such file, or it cannot be read", file));
  json report = json::parse(in, nullptr, false);
  if (report.is_discarded() || !report.is_object() || !report.contains("best") || !report.contains("axes"))
    throw UsageError(fmt::format("error: --compare {}: no report of `voxmelt explore`", file));
  return report;
}

// No two runs take the same time.
bool is_time(const std::string& path) { return path.ends_with(".seconds"); }

struct Difference {
  std::string path, before, after;
  double ratio = 0;  // of two numbers; 0 for anything else
};

// A list of objects that have names is compared by them, so that another order is no difference.
json keyed(const json& value) {
  json result = json::object();
  for (const json& one : value) result[one["name"].get<std::string>()] = one;
  return result;
}

void compare(const std::string& path, const json& a, const json& b, std::vector<Difference>& found) {
  if (a == b || is_time(path)) return;
  const auto named = [](const json& v) {
    return v.is_array() && !v.empty() && v[0].is_object() && v[0].contains("name");
  };
  if (named(a) && named(b)) return compare(path, keyed(a), keyed(b), found);
  if (a.is_object() && b.is_object()) {
    for (const auto& [key, value] : a.items()) compare(path + '.' + key, value, b.value(key, json()), found);
    for (const auto& [key, value] : b.items())
      if (!a.contains(key)) compare(path + '.' + key, json(), value, found);
    return;
  }
  Difference one{path, a.is_null() ? "none" : a.dump(), b.is_null() ? "none" : b.dump()};
  if (a.is_number() && b.is_number() && a.get<double>() != 0) one.ratio = b.get<double>() / a.get<double>();
  found.push_back(one);
}

template <std::size_t N>
std::vector<Difference> of_parts(const char* const (&parts)[N], const json& a, const json& b) {
  std::vector<Difference> found;
  for (const char* part : parts) compare(part, a.value(part, json()), b.value(part, json()), found);
  return found;
}

std::string text_of(const char* what, const std::vector<Difference>& found) {
  if (found.empty()) return fmt::format("{}: the same\n", what);
  std::string text = fmt::format("{}:\n", what);
  for (const Difference& one : found)
    text += fmt::format("  {:<44} {:>20}  {:>20}{}\n", one.path, one.before, one.after,
                        one.ratio > 0 ? fmt::format("  x {:.3f}", one.ratio) : "");
  return text;
}

json json_of(const std::vector<Difference>& found) {
  json list = json::array();
  for (const Difference& one : found)
    list.push_back({{"path", one.path}, {"a", one.before}, {"b", one.after}});
  return list;
}

std::string answer_of(const json& report) {
  return report.contains("answer") && report["answer"].is_string() ? report["answer"].get<std::string>() : "";
}

}  // namespace

int explore_compare(const ExploreCommand& command) {
  const json a = read(command.compared.at(0)), b = read(command.compared.at(1));
  const std::vector<Difference> asked = of_parts(kAsked, a, b), answered = of_parts(kAnswered, a, b);
  print("a: {}\nb: {}\n{}{}", answer_of(a), answer_of(b), text_of("what was asked", asked),
        text_of("what was answered", answered));
  const json report{{"asked", json_of(asked)}, {"answered", json_of(answered)}};
  write_report(command.common, report.dump(2) + '\n');
  return kDone;
}

}  // namespace voxmelt::app
