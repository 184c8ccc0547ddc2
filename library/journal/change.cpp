#include "library/journal/change.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <system_error>

#include "voxmelt/errors.h"

namespace voxmelt::journal {
namespace {

[[noreturn]] void fail(const Change& change, const std::string& what) {
  throw InputError(fmt::format("error: {} {}", change.key, what));
}

// Is a key of a list: "vent.0.rate" has the list "vent", the index 0 and the part "rate".
struct ListKey {
  std::string_view list, part;
  std::optional<std::size_t> index;  // none for ".add"
};
std::optional<ListKey> list_key(std::string_view key) {
  const std::size_t dot = key.find('.');
  if (dot == key.npos) return {};
  ListKey result{key.substr(0, dot), {}, {}};
  if (result.list != "heat_source" && result.list != "vent" && result.list != "drain") return {};
  const std::string_view rest = key.substr(dot + 1);
  if (rest.starts_with("add") && rest.find('.') == rest.npos) {
    result.part = rest;
    return result;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
  const auto length = static_cast<std::size_t>(end - rest.data());
  if (error != std::errc() || length >= rest.size() || rest[length] != '.') return {};
  result.index = index;
  result.part = rest.substr(length + 1);
  return result;
}

void need(const Change& change, std::size_t count) {
  if (change.numbers.size() != count)
    fail(change,
         fmt::format("takes {} number{}, not {}", count, count == 1 ? "" : "s", change.numbers.size()));
}
double one(const Change& change) {
  need(change, 1);
  return change.numbers[0];
}
Position place(const Change& change) {
  need(change, 3);
  return {change.numbers[0], change.numbers[1], change.numbers[2]};
}

// Returns what a source is at a step. Between keyframes all numbers change linearly.
Keyframe present(const HeatSource& source, std::uint32_t step) {
  const std::vector<Keyframe>& keys = source.keyframes;
  if (step <= keys.front().step) return keys.front();
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (step >= keys[i].step) continue;
    const Keyframe &a = keys[i - 1], &b = keys[i];
    const double part = double{static_cast<double>(step - a.step)} / (b.step - a.step);
    const auto between = [&](double from, double to) { return from + (to - from) * part; };
    Keyframe now{.step = 0, .power = between(a.power, b.power), .radius = between(a.radius, b.radius)};
    for (std::size_t k = 0; k < 3; ++k) {
      now.at[k] = between(a.at[k], b.at[k]);
      now.direction[k] = between(a.direction[k], b.direction[k]);
    }
    return now;
  }
  return keys.back();
}

// Makes a source of the numbers that its kind has.
HeatSource new_source(const Change& change, HeatSourceKind kind) {
  const std::vector<double>& n = change.numbers;
  constexpr std::array<std::size_t, kHeatSourceKinds> kNumbers{4, 5, 4, 1};
  need(change, kNumbers[static_cast<std::size_t>(kind)]);
  Keyframe key{.power = n.back()};
  if (kind == HeatSourceKind::point || kind == HeatSourceKind::sphere) key.at = {n[0], n[1], n[2]};
  if (kind == HeatSourceKind::sphere) key.radius = n[3];
  if (kind == HeatSourceKind::directional) key.direction = {n[0], n[1], n[2]};
  return {{key}, kind};
}

// Returns the kind that a word names, if it does.
using KindNames = std::array<std::string_view, kHeatSourceKinds>;
std::optional<HeatSourceKind> kind_of(std::string_view word, const KindNames& names) {
  const auto found = std::ranges::find(names, word);
  if (found == names.end()) return {};
  return static_cast<HeatSourceKind>(found - names.begin());
}

// A source that a hand moves has one keyframe from then on: what it is at this step.
void change_source(const Change& change, std::string_view part, std::uint32_t step, HeatSource& source) {
  constexpr KindNames kKinds{"point", "sphere", "sun", "sky"};
  if (const auto kind = kind_of(part, kKinds)) {
    source = new_source(change, *kind);
    return;
  }
  Keyframe now = present(source, step);
  now.step = 0;
  const bool has_place = source.kind == HeatSourceKind::point || source.kind == HeatSourceKind::sphere;
  if (part == "at" && has_place)
    now.at = place(change);
  else if (part == "power")
    now.power = one(change);
  else if (part == "radius" && source.kind == HeatSourceKind::sphere)
    now.radius = one(change);
  else if (part == "direction" && source.kind == HeatSourceKind::directional)
    now.direction = place(change);
  else
    fail(change, "is not a key of such a source");
  source.keyframes = {now};
}

// An opening that is on is open at every step. One that is off opens at a step that no run comes to.
template <class Opening>
void switch_opening(const Change& change, bool on, Opening& opening) {
  need(change, 0);
  opening.from = on ? 0 : kNever - 1;
  opening.until = kNever;
}

template <class Opening>
void change_opening(const Change& change, std::string_view part, Opening& opening) {
  if (part == "at")
    opening.at = place(change);
  else if (part == "radius")
    opening.radius = one(change);
  else if (part == "rate")
    opening.rate = one(change);
  else if (part == "on" || part == "off")
    switch_opening(change, part == "on", opening);
  else if constexpr (requires { opening.temperature; }) {
    if (part != "temperature") fail(change, "is not a key of a vent");
    opening.temperature = one(change);
  } else {
    fail(change, "is not a key of a drain");
  }
}

// Changes one of a list, or removes it.
template <class One, class Edit>
void edit(const Change& change, const ListKey& key, std::vector<One>& list, const Edit& change_it) {
  if (*key.index >= list.size()) fail(change, fmt::format("is not there: there are {} of them", list.size()));
  if (key.part == "remove") {
    need(change, 0);
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(*key.index));
  } else {
    change_it(key.part, list[*key.index]);
  }
}

void apply_to_sources(const Change& change, const ListKey& key, World& world) {
  std::vector<HeatSource> sources = world.heat_sources();
  if (!key.index) {
    constexpr KindNames kWays{"add", "add_sphere", "add_sun", "add_sky"};
    const auto kind = kind_of(key.part, kWays);
    if (!kind) fail(change, "is no way to add a source");
    sources.push_back(new_source(change, *kind));
  } else {
    edit(change, key, sources, [&](std::string_view part, HeatSource& source) {
      change_source(change, part, world.step_number(), source);
    });
  }
  world.set_heat_sources(sources);
}

void apply_to_vents(const Change& change, const ListKey& key, World& world) {
  std::vector<Vent> vents = world.vents();
  if (!key.index) {
    if (key.part != "add") fail(change, "is no way to add a vent");
    need(change, 6);
    const std::vector<double>& n = change.numbers;
    vents.push_back({.at = {n[0], n[1], n[2]}, .radius = n[3], .rate = n[4], .temperature = n[5]});
  } else {
    edit(change, key, vents, [&](std::string_view part, Vent& vent) { change_opening(change, part, vent); });
  }
  world.set_vents(vents);
}

void apply_to_drains(const Change& change, const ListKey& key, World& world) {
  std::vector<Drain> drains = world.drains();
  if (!key.index) {
    if (key.part != "add") fail(change, "is no way to add a drain");
    need(change, 5);
    const std::vector<double>& n = change.numbers;
    drains.push_back({.at = {n[0], n[1], n[2]}, .radius = n[3], .rate = n[4]});
  } else {
    edit(change, key, drains,
         [&](std::string_view part, Drain& drain) { change_opening(change, part, drain); });
  }
  world.set_drains(drains);
}

bool apply_to_matter(const Change& change, World& world) {
  const std::vector<double>& n = change.numbers;
  if (change.key == "pour") {
    need(change, 5);
    world.pour({n[0], n[1], n[2]}, n[3], n[4]);
  } else if (change.key == "carve") {
    need(change, 4);
    world.carve({n[0], n[1], n[2]}, n[3]);
  } else {
    return false;
  }
  return true;
}

}  // namespace

Change read_change(std::string_view text) {
  Change change;
  constexpr std::string_view kSpace = " \t";
  bool first = true;
  for (std::size_t at = text.find_first_not_of(kSpace); at != text.npos; first = false) {
    const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = text.find_first_not_of(kSpace, end);
    if (first) {
      change.key = word;
      continue;
    }
    double number = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || rest != word.data() + word.size() || !std::isfinite(number))
      fail(change, fmt::format("{}: not a number", word));
    change.numbers.push_back(number);
  }
  if (change.key.empty()) throw InputError("error: no key");
  return change;
}

std::string text_of(const Change& change) {
  std::string text = change.key;
  for (const double number : change.numbers) fmt::format_to(std::back_inserter(text), " {}", number);
  return text;
}

void apply(const Change& change, World& world) {
  if (apply_to_matter(change, world)) return;
  const std::optional<ListKey> key = list_key(change.key);
  if (!key) return world.set(change.key, one(change));
  if (key->list == "heat_source") return apply_to_sources(change, *key, world);
  if (key->list == "vent") return apply_to_vents(change, *key, world);
  apply_to_drains(change, *key, world);
}

}  // namespace voxmelt::journal
