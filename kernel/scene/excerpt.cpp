#include "kernel/scene/excerpt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/print.h"

namespace voxmelt::scene {
namespace {

constexpr std::array kPlaced{"vent", "drain", "heat_source"};

void move(Value& table, const std::array<int, 3>& by) {
  Value* at = table.find("at");
  if (at != nullptr && at->kind == Value::Kind::array)
    for (std::size_t axis = 0; axis < std::min<std::size_t>(3, at->items.size()); ++axis) {
      Value& place = at->items[axis];
      place.integer -= by[axis];
      place.real -= by[axis];
    }
  if (Value* frames = table.find("keyframes"))
    for (Value& frame : frames->items) move(frame, by);
}

Value number(std::int64_t value) {
  Value result;
  result.kind = Value::Kind::integer;
  result.integer = value;
  return result;
}

Value& table_of(Value& document, const std::string& key) {
  Value* found = document.find(key);
  return found != nullptr && found->kind == Value::Kind::table ? *found : document.put(key, Value{});
}

}  // namespace

Excerpt::Excerpt(const std::filesystem::path& file, const std::vector<std::string>& overrides)
    : document_(read_document(file)) {
  for (const std::string& assignment : overrides) apply_override(document_, assignment);
  for (const char* key :
       {"title", "description", "solid", "liquid", "inert", "start", "camera", "light", "look"})
    document_.remove(key);
  if (Value* run = document_.find("run")) {
    run->remove("steps");
    run->remove("frame_every");
    if (run->keys.empty()) document_.remove("run");
  }
}

std::vector<std::string> Excerpt::removable() const {
  std::vector<std::string> names;
  for (const char* key : kPlaced)
    if (const Value* all = document_.find(key); all != nullptr && all->kind == Value::Kind::array)
      for (std::size_t i = 0; i < all->items.size(); ++i) names.push_back(fmt::format("{}.{}", key, i));
  const Value* heat = document_.find("heat");
  if (heat != nullptr && heat->find("air") != nullptr) names.emplace_back("heat.air");
  return names;
}

std::string Excerpt::text(const Part& part, const std::string& fields, std::uint32_t step) const {
  Value document = document_;
  const auto is_left_out = [&](const std::string& name) {
    return std::find(part.without.begin(), part.without.end(), name) != part.without.end();
  };
  for (const char* key : kPlaced) {
    Value* all = document.find(key);
    if (all == nullptr || all->kind != Value::Kind::array) continue;
    std::vector<Value> kept;
    for (std::size_t i = 0; i < all->items.size(); ++i)
      if (!is_left_out(fmt::format("{}.{}", key, i))) kept.push_back(all->items[i]);
    for (Value& one : kept) move(one, part.from);
    all->items = std::move(kept);
    if (all->items.empty()) document.remove(key);
  }
  if (is_left_out("heat.air")) document.find("heat")->remove("air");
  Value size;
  size.kind = Value::Kind::array;
  for (const int side : part.size) size.items.push_back(number(side));
  table_of(document, "grid").put("size", std::move(size));
  Value folder;
  folder.kind = Value::Kind::text;
  folder.text = fields;
  Value& start = table_of(document, "start");
  start.put("fields", std::move(folder));
  start.put("step", number(step));
  return print_document(document);
}

}  // namespace voxmelt::scene
