#include "library/sources.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "kernel/scene/parameter_readers.h"
#include "kernel/scene/text/document.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::library {
namespace {

using scene::Value;

// HeatSourceKind has the order of rule::SourceKind. A number beyond both has no name and no keys, and is
// refused.
static_assert(kHeatSourceKinds == rule::kSourceKinds.size());
rule::SourceKindRow row_of(HeatSourceKind kind) {
  const auto number = static_cast<std::size_t>(kind);
  if (number < rule::kSourceKinds.size()) return rule::kSourceKinds[number];
  return {.kind = {}, .name = "none"};
}

// Builds the document that a scene file with these tables would give.
class Document {
 public:
  explicit Document(const char* caller)
      : place_{std::make_shared<const scene::Origin>(scene::Origin{caller, {}, false}), 0, 0} {}

  Value value(Value::Kind kind) const {
    Value value;
    value.kind = kind;
    value.place = value.key_place = place_;
    return value;
  }
  Value table() const { return value(Value::Kind::table); }
  Value array(std::vector<Value> items) const {
    Value array = value(Value::Kind::array);
    array.items = std::move(items);
    return array;
  }
  Value number(double number) const {
    Value real = value(Value::Kind::real);
    real.real = number;
    return real;
  }
  Value step(std::uint32_t step) const {
    Value integer = value(Value::Kind::integer);
    integer.integer = step;
    integer.real = step;
    return integer;
  }
  Value text(std::string_view text) const {
    Value string = value(Value::Kind::text);
    string.text = text;
    return string;
  }
  Value position(const Position& at) const { return array({number(at[0]), number(at[1]), number(at[2])}); }

  // Returns the document with one list [[key]]. Each of its tables is made by to_table.
  template <class Item, class ToTable>
  Value list(const char* key, const std::vector<Item>& items, const ToTable& to_table) const {
    std::vector<Value> tables;
    tables.reserve(items.size());
    for (const Item& item : items) tables.push_back(to_table(item));
    Value root = table();
    root.put(key, array(std::move(tables)));
    return root;
  }

 private:
  scene::Place place_;
};

template <class Source>  // makes the keys that vents and drains share
Value region_table(const Document& document, const Source& source) {
  Value table = document.table();
  table.put("at", document.position(source.at));
  table.put("radius", document.number(source.radius));
  table.put("rate", document.number(source.rate));
  table.put("from", document.step(source.from));
  table.put("until", document.step(source.until));
  return table;
}

Value list_of(const Document& document, const std::vector<HeatSource>& sources) {
  return document.list("heat_source", sources, [&](const HeatSource& source) {
    const rule::SourceKindRow kind = row_of(source.kind);
    Value table = document.list("keyframes", source.keyframes, [&](const Keyframe& keyframe) {
      Value frame = document.table();
      frame.put("step", document.step(keyframe.step));
      if (kind.at) frame.put("at", document.position(keyframe.at));
      if (kind.radius) frame.put("radius", document.number(keyframe.radius));
      if (kind.direction) frame.put("direction", document.position(keyframe.direction));
      frame.put("power", document.number(keyframe.power));
      return frame;
    });
    table.put("kind", document.text(kind.name));
    return table;
  });
}

Value list_of(const Document& document, const std::vector<Vent>& vents) {
  return document.list("vent", vents, [&](const Vent& vent) {
    Value table = region_table(document, vent);
    table.put("temperature", document.number(vent.temperature));
    table.put("energy", document.number(vent.energy));
    return table;
  });
}

Value list_of(const Document& document, const std::vector<Drain>& drains) {
  return document.list("drain", drains, [&](const Drain& drain) { return region_table(document, drain); });
}

template <class Rule>
Rule checked(const Value& root, Rule (*read)(scene::Reader&)) {
  scene::Reader reader(root, "");
  return read(reader);
}

Position to_cells(const rule::Position& at) {
  const auto cells = [](std::int64_t v) { return static_cast<double>(v) / rule::kPositionUnit; };
  return {cells(at.x), cells(at.y), cells(at.z)};
}
Position to_direction(const rule::Position& d) {
  const auto part = [](std::int64_t v) { return static_cast<double>(v) / scene::kDirectionUnit; };
  return {part(d.x), part(d.y), part(d.z)};
}
double to_cells(std::int64_t length) { return static_cast<double>(length) / rule::kPositionUnit; }
double to_part(rule::Amount amount) { return static_cast<double>(amount) / rule::kOne; }

}  // namespace

std::vector<rule::HeatSource> to_rules(const std::vector<HeatSource>& sources) {
  return checked(list_of(Document("set_heat_sources"), sources), scene::read_heat_sources);
}

std::vector<rule::Vent> to_rules(const std::vector<Vent>& vents) {
  return checked(list_of(Document("set_vents"), vents), scene::read_vents);
}

std::vector<rule::Drain> to_rules(const std::vector<Drain>& drains) {
  return checked(list_of(Document("set_drains"), drains), scene::read_drains);
}

rule::Region to_region(const char* caller, const Position& at, double radius) {
  const Document document(caller);
  Value table = document.table();
  table.put("at", document.position(at));
  table.put("radius", document.number(radius));
  return checked(table, scene::read_region);
}

rule::Temperature to_temperature(const char* caller, double temperature) {
  const Document document(caller);
  Value table = document.table();
  table.put("temperature", document.number(temperature));
  return checked(table, scene::read_temperature);
}

scene::Value lists_of(const rule::Parameters& parameters) {
  const Document document("the scene");
  Value root = document.table();
  const auto put = [&](const char* key, const auto& rules) {
    std::vector<decltype(from_rule(rules.front()))> all;
    for (const auto& rule : rules) all.push_back(from_rule(rule));
    root.put(key, *list_of(document, all).find(key));
  };
  put("heat_source", parameters.heat.sources);
  put("vent", parameters.vents);
  put("drain", parameters.drains);
  return root;
}

HeatSource from_rule(const rule::HeatSource& source) {
  HeatSource result;
  result.kind = static_cast<HeatSourceKind>(source.kind);
  for (const rule::SourceKey& key : source.keys)
    result.keyframes.push_back({key.step, to_cells(key.at), scene::from_power(key.power),
                                to_cells(key.radius), to_direction(key.direction)});
  return result;
}

Vent from_rule(const rule::Vent& vent) {
  return {to_cells(vent.region.at),
          to_cells(vent.region.radius),
          to_part(vent.rate),
          static_cast<double>(vent.temperature) / rule::kTemperatureMax,
          to_part(vent.energy),
          vent.from,
          vent.until};
}

Drain from_rule(const rule::Drain& drain) {
  return {to_cells(drain.region.at), to_cells(drain.region.radius), to_part(drain.rate), drain.from,
          drain.until};
}

}  // namespace voxmelt::library
