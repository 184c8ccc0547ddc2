#include "app/run_record.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/export.h"
#include "render/frames/film_writer.h"
#include "render/frames/webp_bytes.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::app {
namespace {

using json = nlohmann::ordered_json;

// The library would cut or turn a number that its type does not hold.
template <class Whole>
Whole whole(const json& value, const char* name, const std::filesystem::path& file) {
  const bool fits = value.is_number_unsigned()  ? std::in_range<Whole>(value.get<std::uint64_t>())
                    : value.is_number_integer() ? std::in_range<Whole>(value.get<std::int64_t>())
                                                : false;
  if (!fits) checkpoint::fail(file, std::string("its head: command.") + name + " is out of its range");
  return value.get<Whole>();
}

json frames_json(const RunRecord& record) {
  json frames = json::array();
  for (std::size_t i = 0; i < record.frames.size(); ++i)
    frames.push_back({{"file", record.frames[i].name},
                      {"step", record.frame_steps[i]},
                      {"bytes", record.frames[i].bytes},
                      {"xxh3", record.frames[i].digest}});
  return frames;
}

// Reads the frames. They stand in their order, so that none can be missing in the middle.
void read_frames(const json& frames, RunRecord& record, const std::filesystem::path& file) {
  for (const json& frame : frames) {
    record.frames.push_back({frame.at("file").get<std::string>(),
                             whole<std::uint64_t>(frame.at("bytes"), "frames.bytes", file),
                             whole<std::uint64_t>(frame.at("xxh3"), "frames.xxh3", file)});
    const auto step = whole<std::uint32_t>(frame.at("step"), "frames.step", file);
    if (!frame_is_due(record, step) || frames_due_before(record, step) != record.frame_steps.size())
      checkpoint::fail(file, "its head: the frames are not those of the steps before");
    record.frame_steps.push_back(step);
  }
}

void read_write(const json& object, RunRecord& record, const std::filesystem::path& file) {
  record.write = object.at("write").get<std::vector<std::string>>();
  record.write_every = whole<std::uint32_t>(object.at("write_every"), "write_every", file);
  for (const std::string& name : record.write)
    if (io::find_format(name) == nullptr)
      checkpoint::fail(file, "its head: command.write is none of this program's formats");
  if (!object.contains("surface")) return;
  record.surface = object.at("surface").get<std::string>();
  if (std::ranges::find(kSurfaces, record.surface) == kSurfaces.end())
    checkpoint::fail(file, "its head: command.surface is none of this program's");
}

}  // namespace

std::vector<std::string> left_out_of(const std::optional<std::string>& keep) {
  if (!keep) return {};
  std::vector<std::string> left_out(kKept.begin(), kKept.end());
  std::istringstream words(*keep + ",");
  for (std::string name; std::getline(words, name, ',');)
    if (std::erase(left_out, name) == 0 && name != "report")
      throw UsageError("--keep " + *keep + ": error: '" + name +
                       "' comes twice, or is not one of report, frames, sheet, film, state");
  return left_out;
}

bool is_kept(const RunRecord& record, std::string_view name) {
  return std::ranges::find(record.left_out, name) == record.left_out.end();
}

std::string film_named(const std::string& name) {
  if (render::wants_webp(render::film_kind_named(name).value()) && !render::webp_is_built_in())
    throw UsageError("--film " + name + ": error: this build has no libwebp: " + render::kWebpCommand);
  return name;
}

bool frame_is_due(const RunRecord& record, std::uint32_t step) {
  return step == 0 || (record.frame_every > 0 && (step % record.frame_every == 0 || step == record.steps));
}

bool write_is_due(const RunRecord& record, std::uint32_t step) {
  return !record.write.empty() &&
         (step == 0 || step == record.steps || (record.write_every > 0 && step % record.write_every == 0));
}

std::size_t frames_due_before(const RunRecord& record, std::uint32_t step) {
  if (step == 0) return 0;
  return std::size_t{1} + (record.frame_every == 0 ? 0 : (step - 1) / record.frame_every);
}

std::string json_of(const RunRecord& record) {
  const Common& common = record.common;
  json result{{"steps", record.steps},
              {"frame_every", record.frame_every},
              {"size", record.size},
              {"setting", record.setting},
              {"checkpoint_every", record.checkpoint_every},
              {"fps", record.frames_per_second},
              {"id", record.id},
              {"out", record.shown_place},
              {"implementation", common.implementation},
              {"visibility", common.visibility},
              {"threads", common.threads},
              {"sets", common.sets},
              {"report", common.report},
              {"quiet", common.quiet},
              {"frames", frames_json(record)},
              {"watch", {record.seen.largest, record.seen.x, record.seen.y, record.seen.z, record.seen.step}},
              {"seconds",
               {record.seconds.update, record.seconds.render, record.seconds.encode, record.seconds.wait,
                record.seconds.total}}};
  if (record.seconds.on_device > 0) result["seconds"].push_back(record.seconds.on_device);
  if (!record.write.empty()) {
    result["write"] = record.write;
    result["write_every"] = record.write_every;
    if (!record.surface.empty()) result["surface"] = record.surface;
  }
  if (record.film != "auto") result["film"] = record.film;
  if (!record.left_out.empty()) result["left_out"] = record.left_out;
  if (common.seed) result["seed"] = *common.seed;
  if (!record.journal.empty()) {
    result["journal"] = record.journal;
    result["journal_name"] = record.journal_name;
  }
  return result.dump(-1, ' ', false, json::error_handler_t::replace);
}

RunRecord run_record_of(const std::string& text, const std::filesystem::path& file) {
  try {
    const json object = json::parse(text);
    RunRecord record;
    Common& common = record.common;
    record.steps = whole<std::uint32_t>(object.at("steps"), "steps", file);
    record.frame_every = whole<std::uint32_t>(object.at("frame_every"), "frame_every", file);
    record.size = object.at("size").get<std::string>();
    if (object.contains("setting")) record.setting = object.at("setting").get<std::string>();
    if (!render::setting_named(record.setting))
      checkpoint::fail(file, "its head: command.setting is none of this program's");
    record.checkpoint_every = object.at("checkpoint_every").get<std::string>();
    if (object.contains("left_out")) record.left_out = object.at("left_out").get<std::vector<std::string>>();
    if (object.contains("write")) read_write(object, record, file);
    record.id = object.at("id").get<std::string>();
    if (object.contains("fps")) record.frames_per_second = whole<int>(object.at("fps"), "fps", file);
    if (record.frames_per_second < 1 || record.frames_per_second > kMostFramesPerSecond)
      checkpoint::fail(file, "its head: command.fps is out of its range");
    if (object.contains("film")) record.film = object.at("film").get<std::string>();
    if (!render::film_kind_named(record.film))
      checkpoint::fail(file, "its head: command.film is none of this program's");
    record.shown_place = object.at("out").get<std::string>();
    common.implementation = object.at("implementation").get<std::string>();
    common.visibility = object.at("visibility").get<std::string>();
    common.threads = whole<int>(object.at("threads"), "threads", file);
    if (common.threads < 0 || common.threads > 1024)
      checkpoint::fail(file, "its head: command.threads is out of its range");
    common.sets = object.at("sets").get<std::vector<std::string>>();
    common.report = object.at("report").get<std::string>();
    common.quiet = object.at("quiet").get<bool>();
    if (object.contains("seed")) common.seed = whole<std::uint64_t>(object.at("seed"), "seed", file);
    if (object.contains("journal")) {
      record.journal = object.at("journal").get<std::string>();
      record.journal_name = object.at("journal_name").get<std::string>();
    }
    read_frames(object.at("frames"), record, file);
    const json& seen = object.at("watch");
    const auto seconds = object.at("seconds").get<std::vector<double>>();
    if (seen.size() != 5 || seconds.size() < 5 || seconds.size() > 6)
      checkpoint::fail(file, "its head: command.watch or command.seconds is no list of five");
    const auto place = [&](std::size_t i) { return whole<int>(seen.at(i), "watch", file); };
    record.seen = {place(0), place(1), place(2), place(3), whole<std::uint32_t>(seen.at(4), "watch", file)};
    record.seconds = {seconds[0], seconds[1], seconds[2],
                      seconds[3], seconds[4], seconds.size() > 5 ? seconds[5] : 0};
    return record;
  } catch (const json::exception& error) {
    checkpoint::fail(file, std::string("its head: command: ") + error.what());
  }
}

}  // namespace voxmelt::app
