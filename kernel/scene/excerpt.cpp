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

Value real(double value) {
  Value result;
  result.kind = Value::Kind::real;
  result.real = value;
  return result;
}

Value text_value(std::string value) {
  Value result;
  result.kind = Value::Kind::text;
  result.text = std::move(value);
  return result;
}

Value array_of(std::vector<Value> items) {
  Value result;
  result.kind = Value::Kind::array;
  result.items = std::move(items);
  return result;
}

Value& table_of(Value& document, const std::string& key) {
  Value* found = document.find(key);
  return found != nullptr && found->kind == Value::Kind::table ? *found : document.put(key, Value{});
}

void put_start(Value& document, const Part& part, const std::string& fields, std::uint32_t step) {
  table_of(document, "grid")
      .put("size", array_of({number(part.size[0]), number(part.size[1]), number(part.size[2])}));
  Value& start = table_of(document, "start");
  start.put("fields", text_value(fields));
  start.put("step", number(step));
}

void put_camera(Value& document, const Camera& camera, const std::array<int, 3>& by) {
  Value table;
  table.put("target", array_of({real(camera.target[0] - by[0]), real(camera.target[1] - by[1]),
                                real(camera.target[2] - by[2])}));
  table.put("azimuth", real(camera.azimuth));
  table.put("elevation", real(camera.elevation));
  table.put("distance", real(camera.distance));
  table.put("field_of_view", real(camera.field_of_view));
  table.put("projection", text_value(camera.orthographic ? "orthographic" : "perspective"));
  table.put("width", number(camera.width));
  table.put("height", number(camera.height));
  document.put("camera", std::move(table));
}

// Keeps floors and height fields alone, with absolute paths of their files.
void keep_terrain(Value& document) {
  Value* all = document.find("inert");
  if (all == nullptr || all->kind != Value::Kind::array) return;
  std::vector<Value> kept;
  for (Value& entry : all->items) {
    const Value* shape = entry.find("shape");
    if (shape == nullptr || (shape->text != "floor" && shape->text != "heightfield")) continue;
    if (Value* file = entry.find("file"); file != nullptr && file->place.origin != nullptr)
      file->text =
          std::filesystem::absolute(file->place.origin->folder / file->text).lexically_normal().string();
    kept.push_back(std::move(entry));
  }
  all->items = std::move(kept);
  if (all->items.empty()) document.remove("inert");
}

}  // namespace

Excerpt::Excerpt(const std::filesystem::path& file, const std::vector<std::string>& overrides)
    : document_(read_document(file)) {
  for (const std::string& assignment : overrides) apply_override(document_, assignment);
  for (const char* key : {"title", "description", "solid", "liquid", "start"}) document_.remove(key);
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
  const Value* grid = document_.find("grid");
  if (grid != nullptr && grid->find("border") != nullptr) names.emplace_back("grid.border");
  const Value* heat = document_.find("heat");
  if (heat != nullptr && heat->find("air") != nullptr) names.emplace_back("heat.air");
  return names;
}

std::string Excerpt::text(const Part& part, const std::string& fields, std::uint32_t step) const {
  Value document = document_;
  for (const char* key : {"inert", "camera", "light", "look"}) document.remove(key);
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
  if (is_left_out("grid.border")) document.find("grid")->remove("border");
  if (is_left_out("heat.air")) document.find("heat")->remove("air");
  put_start(document, part, fields, step);
  return print_document(document);
}

std::string Excerpt::picture_text(const Part& part, const std::string& fields, const Camera& camera) const {
  Value document = document_;
  for (const char* key : kPlaced) document.remove(key);
  document.remove("run");
  const bool bare = std::find(part.without.begin(), part.without.end(), "terrain") != part.without.end();
  if (bare)
    document.remove("inert");
  else
    keep_terrain(document);
  put_camera(document, camera, part.from);
  put_start(document, part, fields, 0);
  return print_document(document);
}

}  // namespace voxmelt::scene
