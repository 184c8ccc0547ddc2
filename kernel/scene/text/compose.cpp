#include "kernel/scene/text/compose.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/guard.h"

namespace voxmelt::scene {
namespace {

constexpr int kDeepestExtends = 8;

void merge(Value& base, Value&& over) {
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    Value* old = base.find(over.keys[i]);
    if (old && old->kind == Value::Kind::table && over.items[i].kind == Value::Kind::table) {
      merge(*old, std::move(over.items[i]));
    } else {
      base.put(std::move(over.keys[i]), std::move(over.items[i]));
    }
  }
  base.place = over.place;
}

// Drops the settings of the law that a sister scene leaves. A sister that changes the law does not inherit
// them.
void drop_other_law(Value& base, const Value& over) {
  const Value* over_flow = over.find("flow");
  const Value* law = over_flow ? over_flow->find("law") : nullptr;
  Value* flow = base.find("flow");
  if (!law || law->kind != Value::Kind::text || !flow || flow->kind != Value::Kind::table) return;
  for (const char* other : {"paper", "viscous"})
    if (law->text != other) flow->remove(other);
}

Value read_document(const std::filesystem::path& file, int depth) {
  Value document = parse_file(file);
  const Value* extends = document.find("extends");
  if (!extends) return document;

  if (extends->kind != Value::Kind::text || extends->text.empty())
    fail_at(extends->place, "extends must be the name of a scene file");
  if (depth == kDeepestExtends)
    fail_at(extends->place,
            fmt::format("extends is nested more than {} deep: does a scene extend itself?", kDeepestExtends));
  const std::filesystem::path base_file = (file.parent_path() / extends->text).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::exists(base_file, ignored))
    fail_at(extends->place, fmt::format("extends names {}, which does not exist", base_file.string()));
  document.remove("extends");
  Value base = read_document(base_file, depth + 1);
  drop_other_law(base, document);
  merge(base, std::move(document));
  return base;
}

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// Shortens an assignment to what a line of a message bears.
std::string shown(const std::string& assignment) {
  constexpr std::size_t kMost = 200;
  return assignment.size() <= kMost ? assignment : assignment.substr(0, kMost) + "...";
}

bool is_key(const std::string& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) {
    return is_digit(c) || is_letter(c) || c == '_' || c == '-';
  });
}

bool is_index(const std::string& part) {
  return !part.empty() && part.size() <= 6 && std::all_of(part.begin(), part.end(), is_digit);
}

// Goes one step down the path, to the element or member `part`. It makes an empty table if a table lacks it.
Value& descend(Value& at, const std::string& part, const std::string& walked, const Place& place) {
  if (at.kind == Value::Kind::array) {
    if (!is_index(part))
      fail_at(place, fmt::format("{} is an array: its elements are {}.0, {}.1, ...", walked, walked, walked));
    std::size_t index = 0;
    std::from_chars(part.data(), part.data() + part.size(), index);
    if (index >= at.items.size())
      fail_at(place,
              fmt::format("there is no {}.{}: {} has {} elements", walked, part, walked, at.items.size()));
    return at.items[index];
  }
  if (at.kind != Value::Kind::table)
    fail_at(place, fmt::format("{} is {}, not a table", walked, name_of(at.kind)));
  if (Value* member = at.find(part)) return *member;
  if (is_index(part)) fail_at(place, fmt::format("there is no {}.{}", walked, part));
  Value table;
  table.place = table.key_place = place;
  return at.put(part, std::move(table));
}

}  // namespace

Value read_document(const std::filesystem::path& file) { return read_document(file, 0); }

void apply_override(Value& document, const std::string& assignment) {
  auto origin = std::make_shared<const Origin>(Origin{"--set " + shown(assignment), {}, true});
  const Place place{origin, 0, 0};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    fail_at(place, "expected path.to.key=value, for example heat.gamma=0.2");
  const std::vector<std::string> parts = split_path(assignment.substr(0, equals));
  if (parts.size() > kDeepestKey) fail_at(place, fmt::format("a key of more than {} parts", kDeepestKey));
  if (!std::all_of(parts.begin(), parts.end(), is_key))
    fail_at(place, "expected names separated by dots before '=', for example heat.gamma=0.2");
  if (equals + 1 == assignment.size()) fail_at(place, "there is no value after '='");
  Value value = parse_value(assignment.substr(equals + 1), origin);

  Value* at = &document;
  std::string walked;
  for (const std::string& part : parts) {
    at = &descend(*at, part, walked.empty() ? "the scene" : walked, place);
    walked += (walked.empty() ? "" : ".") + part;
  }
  *at = std::move(value);
}

}  // namespace voxmelt::scene
