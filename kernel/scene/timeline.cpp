#include "kernel/scene/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "kernel/scene/text/print.h"

namespace voxmelt::scene {
namespace {

constexpr std::uint32_t kLastStep = 0xFFFFFFFF;

Value text_value(std::string text) {
  Value value;
  value.kind = Value::Kind::text;
  value.text = std::move(text);
  return value;
}

void make_whole(Value* file) {
  if (file == nullptr || file->kind != Value::Kind::text || !file->place.origin) return;
  file->text = std::filesystem::absolute(file->place.origin->folder / file->text).lexically_normal().string();
}

// Returns the list [[change]], one entry for each step.
Value list_of(const std::vector<Change>& changes) {
  Value list;
  list.kind = Value::Kind::array;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (i == 0 || changes[i].step != changes[i - 1].step) {
      Value step, words;
      step.kind = Value::Kind::integer;
      step.integer = changes[i].step;
      words.kind = Value::Kind::array;
      Value& entry = list.items.emplace_back();
      entry.put("step", std::move(step));
      entry.put("do", std::move(words));
    }
    list.items.back().find("do")->items.push_back(text_value(changes[i].what));
  }
  return list;
}

void sort_by_step(std::vector<Change>& changes) { std::ranges::stable_sort(changes, {}, &Change::step); }

}  // namespace

std::vector<Change> read_timeline(Reader& root) {
  std::vector<Change> changes;
  for (Reader& reader : root.tables("change")) {
    const std::uint32_t step = reader.integer("step", 0, kLastStep);
    for (const Value* one : reader.texts("do")) changes.push_back({step, one->text, one->place.text()});
    reader.finish();
  }
  sort_by_step(changes);
  return changes;
}

std::string portable_text(Value document) {
  for (const char* name : {"solid", "liquid", "inert"})
    if (Value* list = document.find(name))
      for (Value& shape : list->items) make_whole(shape.find("file"));
  if (Value* start = document.find("start")) make_whole(start->find("fields"));
  return print_document(document);
}

std::string with_timeline(const std::string& text, const std::vector<Change>& more) {
  Value document = parse_text(text, std::make_shared<const Origin>(Origin{"the scene", {}, false}));
  Reader root(document, "");
  std::optional<Reader> start = root.table("start");
  const std::uint32_t first = start ? start->integer("step", 0, kLastStep, 0) : 0;
  std::vector<Change> all = more;
  for (Change& one : all) {
    if (one.step > kLastStep - first)
      throw InputError(fmt::format(
          "error: a change after {} steps of a scene that begins at step {} is beyond the last one, {}",
          one.step, first, kLastStep));
    one.step += first;
  }
  for (Change& own : read_timeline(root)) all.push_back(std::move(own));
  sort_by_step(all);
  document.remove("change");  // it comes last, where a reader looks for what was added
  if (!all.empty()) document.put("change", list_of(all));
  return print_document(document);
}

}  // namespace voxmelt::scene
