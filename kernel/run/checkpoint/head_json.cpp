#include "kernel/run/checkpoint/head_json.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "kernel/run/checkpoint/blocks.h"

namespace voxmelt::checkpoint {
namespace {

using json = nlohmann::ordered_json;
using state::Sum;

constexpr int kLargestSide = 4096;

std::string hexadecimal(std::uint64_t value) {
  std::string digits(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4) digits[i] = "0123456789abcdef"[value & 15];
  return digits;
}

std::optional<std::uint64_t> from_hexadecimal(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.size() != 16 || error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// Reads a sum of at most 38 digits, which is less than 2^127.
std::optional<Sum> sum_of(std::string_view text) {
  const bool negative = text.starts_with('-');
  const std::string_view digits = text.substr(negative ? 1 : 0);
  if (digits.empty() || digits.size() > 38 || digits.find_first_not_of("0123456789") != digits.npos)
    return {};
  Sum value = 0;
  for (const char digit : digits) value = 10 * value + (digit - '0');
  return negative ? -value : value;
}

template <template <class> class Terms>
json ledger_json(const state::LedgerOf<Terms>& ledger) {
  json result{{"start", state::to_string(ledger.start)}};
  for (const auto& term : Terms<Sum>::table())
    result[std::string(term.name)] = state::to_string(ledger.*term.value);
  return result;
}

json files_json(const std::vector<FileState>& files) {
  json result = json::array();
  for (const FileState& file : files)
    result.push_back({{"file", file.name}, {"bytes", file.bytes}, {"xxh3", hexadecimal(file.digest)}});
  return result;
}

// Gives strict access to one object. A missing value, or one of another kind, is named in the error.
class Object {
 public:
  Object(const json& object, std::string name, const std::filesystem::path& file)
      : object_(object), name_(std::move(name)), file_(file) {
    if (!object.is_object()) fail(file_, "its head has no object " + name_);
  }
  const json& at(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) wrong(key, "is missing");
    return *found;
  }
  Object object(const char* key) const { return {at(key), path(key), file_}; }
  const json& array(const char* key) const {
    if (!at(key).is_array()) wrong(key, "is no array");
    return at(key);
  }
  std::string text(const char* key) const {
    if (!at(key).is_string()) wrong(key, "is no text");
    return at(key).get<std::string>();
  }
  bool flag(const char* key) const {
    if (!at(key).is_boolean()) wrong(key, "is neither true nor false");
    return at(key).get<bool>();
  }
  std::int64_t integer(const char* key, std::int64_t low, std::int64_t high) const {
    const json& value = at(key);
    if (!value.is_number_integer() ||
        (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{INT64_MAX}))
      wrong(key, "is no integer of its range");
    const auto number = value.get<std::int64_t>();
    if (number < low || number > high) wrong(key, "is out of its range");
    return number;
  }
  std::uint32_t step(const char* key) const {
    return static_cast<std::uint32_t>(integer(key, 0, 0xFFFFFFFF));
  }
  std::uint64_t digest(const char* key) const {
    const std::optional<std::uint64_t> value = from_hexadecimal(text(key));
    if (!value) wrong(key, "is no digest of 16 hexadecimal digits");
    return *value;
  }
  Sum sum(const char* key) const {
    const std::optional<Sum> value = sum_of(text(key));
    if (!value) wrong(key, "is no sum in decimal digits");
    return *value;
  }
  [[noreturn]] void wrong(const char* key, const char* what) const {
    fail(file_, "its head: " + path(key) + " " + what);
  }

 private:
  std::string path(const char* key) const { return name_.empty() ? key : name_ + "." + key; }
  const json& object_;
  std::string name_;
  const std::filesystem::path& file_;
};

template <template <class> class Terms>
state::LedgerOf<Terms> ledger_of(const Object& object) {
  state::LedgerOf<Terms> ledger;
  ledger.start = object.sum("start");
  for (const auto& term : Terms<Sum>::table())
    ledger.*term.value = object.sum(std::string(term.name).c_str());
  return ledger;
}

json seconds_json(const state::Seconds& seconds) {
  json result = json::array();
  for (const auto& row : state::Seconds::table()) result.push_back(seconds.*row.value);
  return result;
}

state::Seconds seconds_of(const Object& object) {
  constexpr auto rows = state::Seconds::table();
  const json& list = object.array("seconds");
  if (list.size() != rows.size()) object.wrong("seconds", "are not those of six phases and visibility");
  state::Seconds seconds;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!list[i].is_number()) object.wrong("seconds", "are no numbers");
    seconds.*rows[i].value = list[i].get<double>();
  }
  return seconds;
}

json run_json(const state::MidRun& run) {
  const state::LimitCounts<Sum>& limit = run.ledger.limit;
  return {{"steps_done", run.steps_done},
          {"irradiance_capped", run.irradiance_capped},
          {"rays", run.rays},
          {"rays_cast", run.rays_cast},
          {"mass", ledger_json(run.ledger.mass)},
          {"energy", ledger_json(run.ledger.energy)},
          {"heat", ledger_json(run.ledger.heat)},
          {"limit",
           {{"cells", state::to_string(limit.cells)},
            {"limited_cells", state::to_string(limit.limited_cells)},
            {"mass", state::to_string(limit.mass)},
            {"limited_mass", state::to_string(limit.limited_mass)}}},
          {"seconds", seconds_json(run.seconds)}};
}

state::MidRun run_of(const Object& object) {
  state::MidRun run;
  run.steps_done = object.step("steps_done");
  run.irradiance_capped = object.integer("irradiance_capped", 0, INT64_MAX);
  run.rays = object.integer("rays", 0, INT64_MAX / 2);
  run.rays_cast = object.integer("rays_cast", 0, INT64_MAX / 2);
  run.ledger.mass = ledger_of<state::MassTerms>(object.object("mass"));
  run.ledger.energy = ledger_of<state::EnergyTerms>(object.object("energy"));
  run.ledger.heat = ledger_of<state::HeatTerms>(object.object("heat"));
  const Object limit = object.object("limit");
  run.ledger.limit.cells = limit.sum("cells");
  run.ledger.limit.limited_cells = limit.sum("limited_cells");
  run.ledger.limit.mass = limit.sum("mass");
  run.ledger.limit.limited_mass = limit.sum("limited_mass");
  run.seconds = seconds_of(object);
  return run;
}

json scene_json(const SceneText& scene) {
  return {{"name", scene.name},
          {"file", scene.file},
          {"title", scene.title},
          {"settings", scene.settings},
          {"parameters", scene.parameters},
          {"warnings", scene.warnings},
          {"files", files_json(scene.files)},
          {"initial_digest", hexadecimal(scene.initial_digest)},
          {"terrain", !scene.terrain.empty()},
          {"textured", scene.textured}};
}

SceneText scene_of(const Object& object, const std::filesystem::path& file, state::Grid grid) {
  SceneText scene;
  scene.name = object.text("name");
  scene.file = object.text("file");
  scene.title = object.text("title");
  scene.settings = object.text("settings");
  scene.parameters = object.text("parameters");
  for (const json& warning : object.array("warnings")) {
    if (!warning.is_string()) object.wrong("warnings", "are no texts");
    scene.warnings.push_back(warning.get<std::string>());
  }
  for (const json& one : object.array("files")) {
    const Object entry(one, "scene.files", file);
    scene.files.push_back({entry.text("file"),
                           static_cast<std::uint64_t>(entry.integer("bytes", 0, INT64_MAX)),
                           entry.digest("xxh3")});
  }
  scene.initial_digest = object.digest("initial_digest");
  if (object.flag("terrain")) scene.terrain.resize(grid.columns());
  scene.textured = object.flag("textured");
  return scene;
}

}  // namespace

std::string json_of(const Head& head) {
  const json result{{"version", head.version},       {"grid", {head.grid.x, head.grid.y, head.grid.z}},
                    {"first_step", head.first_step}, {"digest", hexadecimal(head.digest)},
                    {"radiates", head.radiates},     {"scene", scene_json(head.scene)},
                    {"run", run_json(head.run)},     {"command", head.command}};
  return result.dump(1, ' ', false, json::error_handler_t::replace);
}

Head head_of(const std::string& text, const std::filesystem::path& file) {
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded()) fail(file, "its head is no JSON");
  const Object object(document, "", file);
  Head head;
  head.version = object.text("version");
  const json& grid = object.array("grid");
  const auto side = [&](std::size_t i) {
    if (grid.size() != 3 || !grid[i].is_number_unsigned() || grid[i].get<std::uint64_t>() < 1 ||
        grid[i].get<std::uint64_t>() > kLargestSide)
      object.wrong("grid", "is no size of a grid");
    return static_cast<int>(grid[i].get<std::uint64_t>());
  };
  head.grid = {side(0), side(1), side(2)};
  head.first_step = object.step("first_step");
  head.digest = object.digest("digest");
  head.radiates = object.flag("radiates");
  head.scene = scene_of(object.object("scene"), file, head.grid);
  head.run = run_of(object.object("run"));
  head.command = object.text("command");
  return head;
}

}  // namespace voxmelt::checkpoint
