#include "app/runs/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/film.h"
#include "app/options.h"
#include "kernel/run/io/export.h"
#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/print.h"
#include "kernel/scene/text/range.h"
#include "kernel/scene/text/reader.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;
using scene::Value;

constexpr double kFurthest = 1e300;
constexpr std::array kRangeKeys{"from", "to", "count", "scale"};

bool is_scalar(const Value& value) {
  return value.kind != Value::Kind::table && value.kind != Value::Kind::array;
}

// Tells if a table is a range. Any other table leads to keys below it, vent.0.from among them.
bool is_range(const Value& table) {
  return std::ranges::any_of(kRangeKeys, [&](const char* key) {
    const Value* value = table.find(key);
    return value != nullptr && is_scalar(*value);
  });
}

// Returns the text of a value as it stands after the = of --set.
std::string text_of(const Value& value) {
  Value document;
  document.put("v", Value{value});
  std::string text = scene::print_document(document);
  return text.substr(4, text.size() - 5);  // without "v = " and the end of the line
}

// Files of a plan are named relative to it, those of --set relative to the current folder.
Value whole_file(Value value, const std::string& key) {
  const std::string name = key.substr(key.rfind('.') + 1);
  if (value.kind != Value::Kind::text || value.text.empty() || (name != "file" && name != "fields"))
    return value;
  value.text = fs::absolute(value.place.origin->folder / value.text).lexically_normal().string();
  return value;
}

AxisValue value_of(const Value& given, const std::string& key) {
  if (given.kind == Value::Kind::table || given.kind == Value::Kind::date)
    fail_axis(given.place, key,
              fmt::format(" wants numbers, strings, true or false, or arrays of them, not {}",
                          scene::name_of(given.kind)));
  const bool is_number = given.kind == Value::Kind::integer || given.kind == Value::Kind::real;
  return {text_of(whole_file(given, key)), is_number ? std::optional(given.real) : std::nullopt, given.place};
}

// Returns the numbers of a range that is not sampled by chance.
std::vector<AxisValue> numbers_of(const AxisRange& range, const scene::Place& place) {
  std::vector<AxisValue> values;
  const std::size_t gaps = range.count - 1;
  const auto width = static_cast<std::int64_t>(range.to - range.from);
  const bool whole = range.whole && !range.logarithmic && width % static_cast<std::int64_t>(gaps) == 0;
  for (std::size_t i = 0; i < range.count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(gaps);
    const double value = range.logarithmic ? range.from * std::pow(range.to / range.from, share)
                                           : range.from + (range.to - range.from) * share;
    values.push_back(number_value(value, whole, place));
  }
  return values;
}

AxisRange range_of(const Value& table, const std::string& key, Design design) {
  scene::Reader reader(table, "axes." + key);
  AxisRange range;
  const auto numbers = scene::within(kFurthest);
  range.from = reader.number("from", numbers);
  range.to = reader.number("to", numbers);
  range.whole = reader.kind("from") == Value::Kind::integer && reader.kind("to") == Value::Kind::integer;
  range.logarithmic = reader.choice("scale", {"linear", "log"}, 0) == 1;
  if (design == Design::latin_hypercube) {
    if (reader.has("count")) reader.fail("count", ": a Latin hypercube takes as many as `runs` says");
  } else {
    range.count = reader.integer("count", 2, std::int64_t{kMostRuns});
  }
  reader.finish();
  if (!(range.to > range.from)) reader.fail("to", " must be more than from");
  if (range.logarithmic && range.from <= 0) reader.fail("from", " must be more than 0 with scale = \"log\"");
  return range;
}

void add_axis(Plan& plan, Axis axis) {
  for (const Axis& other : plan.axes)
    if (other.key == axis.key)
      fail_axis(axis.place, axis.key, fmt::format(" comes twice; it is at {}, too", other.place.text()));
  if (axis.key.find('=') != std::string::npos) fail_axis(axis.place, axis.key, " is no key of a scene");
  plan.axes.push_back(std::move(axis));
}

void read_axes(const Value& table, const std::string& path, Plan& plan) {
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    const Value& item = table.items[i];
    const std::string key = path.empty() ? table.keys[i] : path + '.' + table.keys[i];
    if (item.kind == Value::Kind::array) {
      if (item.items.empty()) fail_axis(item.place, key, " has no values");
      Axis axis{key, item.key_place, {}, {}};
      for (const Value& value : item.items) axis.values.push_back(value_of(value, key));
      add_axis(plan, std::move(axis));
    } else if (item.kind != Value::Kind::table) {
      fail_axis(item.place, key,
                fmt::format(" must be a list of values, or a range {{ from, to, count }}, not {}",
                            scene::name_of(item.kind)));
    } else if (is_range(item)) {
      const AxisRange range = range_of(item, key, plan.design);
      Axis axis{key, item.key_place, {}, {}};
      if (plan.design == Design::latin_hypercube)
        axis.range = range;
      else
        axis.values = numbers_of(range, item.key_place);
      add_axis(plan, std::move(axis));
    } else if (item.keys.empty()) {
      fail_axis(item.place, key, " has no values");
    } else {
      read_axes(item, key, plan);
    }
  }
}

// Reads a list of names, each once, and joins them by commas.
std::string names(scene::Reader& reader, const char* key, const std::vector<std::string>& known) {
  std::vector<std::string> list;
  if (!reader.has(key)) return {};
  for (const Value* word : reader.texts(key)) {
    if (std::ranges::find(known, word->text) == known.end())
      scene::fail_at(word->place, fmt::format("{}: \"{}\" is not one of {}", reader.name(key), word->text,
                                              fmt::join(known, ", ")));
    if (std::ranges::find(list, word->text) != list.end())
      scene::fail_at(word->place, fmt::format("{}: \"{}\" comes twice", reader.name(key), word->text));
    list.push_back(word->text);
  }
  return fmt::format("{}", fmt::join(list, ","));
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const io::Format& format : io::formats()) names.emplace_back(format.name);
  return names;
}

std::string size_in(scene::Reader& reader) {
  const std::string size = reader.text("size", "");
  scene::Camera camera;
  try {
    if (!size.empty()) set_size(camera, size);
  } catch (const UsageError&) {
    reader.fail("size",
                fmt::format(" = \"{}\" is not WIDTHxHEIGHT, each 16 to {}", size, scene::kWidestPicture));
  }
  return size;
}

// Reads a number of steps, or of seconds as in "60s".
std::string interval_in(scene::Reader& reader, const std::string& fallback) {
  const std::string text = reader.text("checkpoint_every", fallback);
  std::string_view number = text;
  if (number.ends_with('s')) number.remove_suffix(1);
  if (number.empty() || number.size() > 9 || number.front() == '0' ||
      !std::ranges::all_of(number, scene::is_digit))
    reader.fail("checkpoint_every",
                fmt::format(" = \"{}\" is no number of steps, nor of seconds as in 60s", text));
  return text;
}

Keep read_keep(scene::Reader& root) {
  Keep keep;
  std::optional<scene::Reader> reader = root.table("keep");
  if (!reader) return keep;
  const auto number = [&](const char* key, std::int64_t lowest) -> std::optional<std::int64_t> {
    if (!reader->has(key)) return std::nullopt;
    return reader->integer(key, lowest, std::int64_t{UINT32_MAX});
  };
  keep.steps = number("steps", 0);
  keep.frame_every = number("frame_every", 0);
  keep.write = names(*reader, "write", format_names());
  keep.write_every = number("write_every", 0);
  if (keep.write_every && keep.write.empty())
    reader->fail("write_every", ": keep.write says what is written");
  keep.size = size_in(*reader);
  const std::vector<std::string> settings(render::kSettingNames.begin(), render::kSettingNames.end());
  if (reader->has("setting")) keep.setting = settings[reader->choice("setting", settings)];
  keep.kept = names(*reader, "outputs", {"report", "frames", "sheet", "film", "state"});
  keep.checkpoint_every = interval_in(*reader, keep.checkpoint_every);
  reader->finish();
  return keep;
}

}  // namespace

void fail_axis(const scene::Place& place, const std::string& key, const std::string& rest) {
  scene::fail_at(place, "axes." + key + rest);
}

AxisValue number_value(double value, bool whole, const scene::Place& place) {
  if (whole) return {fmt::format("{:.0f}", value), value, place};
  std::string text = fmt::format("{:.6g}", value);
  const double rounded = scene::real_number_in(text).value_or(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return {text, rounded, place};
}

Plan read_plan(const fs::path& file) {
  const Value document = scene::parse_file(file);
  scene::Reader root(document, "");
  Plan plan;
  plan.file = file;
  plan.title = root.text("title", file.stem().string());
  plan.scene = root.text("scene");
  if (plan.scene.empty()) root.fail("scene", " is empty");
  std::error_code ignored;
  if (const fs::path beside = file.parent_path() / plan.scene;
      fs::path(plan.scene).has_extension() || fs::exists(beside, ignored))
    plan.scene = beside.lexically_normal().string();
  plan.design =
      Design{static_cast<std::uint8_t>(root.choice("design", {"grid", "list", "latin_hypercube"}, 0))};
  if (plan.design == Design::latin_hypercube) {
    plan.runs = root.integer("runs", 1, std::int64_t{kMostRuns});
    plan.seed = root.integer("seed", 0, INT64_MAX, 1);
  }
  for (const char* key : {"runs", "seed"})
    if (plan.design != Design::latin_hypercube && document.find(key) != nullptr)
      scene::fail_at(document.find(key)->place,
                     fmt::format("{} goes with design = \"latin_hypercube\"", key));
  root.has("axes");
  plan.keep = read_keep(root);
  root.finish();
  const Value* axes = document.find("axes");
  if (axes == nullptr) scene::fail_at(document.place, "there are no axes: [axes] says what differs");
  if (axes->kind != Value::Kind::table)
    scene::fail_at(axes->place, fmt::format("axes must be a table, not {}", scene::name_of(axes->kind)));
  read_axes(*axes, "", plan);
  if (plan.axes.empty()) scene::fail_at(axes->place, "there are no axes: [axes] says what differs");
  std::ranges::stable_sort(plan.axes, {},
                           [](const Axis& axis) { return std::pair(axis.place.line, axis.place.column); });
  if (plan.keep.steps)
    for (const Axis& axis : plan.axes)
      if (axis.key == "run.steps") fail_axis(axis.place, axis.key, ": keep.steps says it, too");
  return plan;
}

}  // namespace voxmelt::app
