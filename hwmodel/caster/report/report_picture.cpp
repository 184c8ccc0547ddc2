#include "hwmodel/caster/report/report_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "hwmodel/caster/report/report_memory.h"
#include "hwmodel/memory/ratio.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::array kVolumeNames{"levels", "matter", "light", "heights", "texels"};
static_assert(kVolumeNames.size() == kSentVolumes);

std::string text_of(const UploadReport& upload) {
  std::string text =
      fmt::format("upload{}: {} bytes in {} bursts (", upload.whole ? " of everything" : " of what changed",
                  upload.bursts * kBurst, upload.bursts);
  for (std::size_t i = 0; i < kSentVolumes; ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", kVolumeNames[i], upload.bytes[i]);
  return text + fmt::format("), {} words of registers; {} cycles\n", upload.words, upload.cycles);
}

std::string place_of(const FaultPlan::Strike& strike) {
  if (strike.address >= 0) return fmt::format("the line at address {}", strike.address);
  return fmt::format("pixel ({}, {}), sample {}", strike.x, strike.y, strike.sample);
}

nlohmann::ordered_json json_of(const PipeCost& cost) {
  nlohmann::ordered_json json;
  for (const ChannelCost& channel_cost : cost.channels)
    json["channels"].push_back(
        {{"name", channel_cost.name}, {"bits", channel_cost.bits}, {"depth", channel_cost.depth}});
  for (const MemoryCost& memory_cost : cost.memories)
    json["memories"].push_back({{"stage", memory_cost.stage},
                                {"name", memory_cost.name},
                                {"words", memory_cost.words},
                                {"bits", memory_cost.bits}});
  for (const UnitCost& unit_cost : cost.units)
    json["units"].push_back({{"stage", unit_cost.stage},
                             {"multipliers", unit_cost.multipliers},
                             {"dividers", unit_cost.dividers}});
  json["channel_bits"] = cost.channel_bits();
  json["memory_bits"] = cost.memory_bits();
  json["multipliers"] = cost.all_units().multipliers;
  json["dividers"] = cost.all_units().dividers;
  return json;
}

// Lists upper bounds of rays a cycle, each below the one before, and the rate that the run reached.
nlohmann::ordered_json bounds(const PictureReport& report, const Configuration& c) {
  const auto share = [](const Account& a, std::int64_t cycles) { return ratio(cycles, a.total()); };
  const auto busiest = std::max_element(
      report.stages.begin(), report.stages.end(), [&](const StageAccount& a, const StageAccount& b) {
        return share(a.account, a.account.busy) < share(b.account, b.account.busy);
      });
  const Account& a = busiest->account;
  const double reached = ratio(report.rays, report.all_cycles);
  const double bytes = ratio(report.memory.read_bytes + report.memory.written_bytes, report.all_cycles);
  return {{"pipes", c.pipes},
          {"busiest", busiest->name},
          {"busiest_stage", reached / share(a, a.busy)},
          {"fill_and_drain", reached / share(a, a.busy + a.fill + a.drain)},
          {"reached", reached},
          {"bytes_per_cycle", bytes},
          {"most_bytes_per_cycle", c.memory().most_bytes_per_cycle()},
          {"rays_per_byte", reached / bytes}};
}

}  // namespace

nlohmann::ordered_json json_of(const UploadReport& upload) {
  nlohmann::ordered_json json{{"whole", upload.whole},
                              {"bytes", upload.bursts * kBurst},
                              {"bursts", upload.bursts},
                              {"words", upload.words},
                              {"cycles", upload.cycles}};
  for (std::size_t i = 0; i < kSentVolumes; ++i) json["volumes"][kVolumeNames[i]] = upload.bytes[i];
  const Account& a = upload.account;
  json["stage"] = {{"busy", a.busy},     {"starved", a.starved}, {"blocked", a.blocked},
                   {"memory", a.memory}, {"fill", a.fill},       {"drain", a.drain}};
  return json;
}

std::string table_of(const PictureReport& report, const Configuration& c) {
  std::string text = fmt::format("{:<16}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}   in % of {} cycles\n", "stage",
                                 "busy", "starved", "blocked", "memory", "fill", "drain", report.all_cycles);
  for (const StageAccount& stage : report.stages) {
    const Account& a = stage.account;
    const auto part = [&](std::int64_t cycles) { return 100 * ratio(cycles, a.total()); };
    text += fmt::format("{:<16}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}\n", stage.name,
                        part(a.busy), part(a.starved), part(a.blocked), part(a.memory), part(a.fill),
                        part(a.drain));
  }
  text +=
      fmt::format("{:<16}{:>12}{:>12}{:>10}{:>12}\n", "cache", "lookups", "misses", "hits, %", "line, bytes");
  for (const CacheAccount& cache : report.caches)
    text += fmt::format("{:<16}{:>12}{:>12}{:>10.2f}{:>12}\n", cache.name, cache.counts.lookups,
                        cache.counts.misses, 100 - 100 * ratio(cache.counts.misses, cache.counts.lookups),
                        cache.line_bytes);
  text += fmt::format("{} rays; per ray {:.2f} steps of the walk, {:.2f} samples of it, {:.2f} cycles\n",
                      report.rays, ratio(report.leaps, report.rays), ratio(report.samples, report.rays),
                      ratio(report.all_cycles * c.pipes, report.rays));
  text += fmt::format("memory: {} reads, {} bytes read, {} written, bus busy {:.1f} %; {} bytes stored\n",
                      report.memory.reads, report.memory.read_bytes, report.memory.written_bytes,
                      100 * ratio(report.memory.bus_cycles, report.all_cycles), report.memory_bytes);
  for (std::size_t i = 0; i < std::min<std::size_t>(report.uploads.size(), 2); ++i)
    text += text_of(report.uploads[i]);
  if (report.memory.dram) text += memory_text(*report.memory.dram, *c.dram);
  if (!report.cost.channels.empty())
    text += fmt::format("a pipe: {} bits of memories, {} of channels, {} multipliers, {} dividers\n",
                        report.cost.memory_bits(), report.cost.channel_bits(),
                        report.cost.all_units().multipliers, report.cost.all_units().dividers);
  for (const PassCycles& pass : report.passes)
    text += fmt::format("{} pass: {} cycles\n", pass.second ? "second" : "first", pass.cycles);
  text += fmt::format("the last frame: {} cycles, {:.1f} frames a second at {} MHz\n", report.end.cycles,
                      ratio(1e6 * c.clock_mhz, std::max<std::int64_t>(report.end.cycles, 1)), c.clock_mhz);
  text +=
      fmt::format("simulated in {:.2f} s: {:.2f} million cycles a second, {:.2f} million samples a second\n",
                  report.seconds, static_cast<double>(report.all_cycles) / report.seconds / 1e6,
                  static_cast<double>(report.sampled) / report.seconds / 1e6);
  return text;
}

namespace {

using Json = nlohmann::ordered_json;

// A cache's keys stand together: {"levels": {"sets": 64, ...}}.
Json json_of(const Configuration& c) {
  Json json{{"clock_mhz", c.clock_mhz}, {"memory", c.dram ? c.dram->name : "fixed"}};
  for (const CasterKey& key : kCasterKeys) {
    const std::string name(key.name);
    const std::size_t cache = name.find('_');
    const std::string first = name.substr(0, cache);
    if (first == "levels" || first == "matter" || first == "light" || first == "ground")
      json[first][name.substr(cache + 1)] = key.get(c);
    else
      json[name] = key.get(c);
  }
  json["apron"] = c.apron;
  return json;
}

Json json_of(const StageAccount& stage) {
  const Account& a = stage.account;
  return {{"name", stage.name}, {"busy", a.busy}, {"starved", a.starved}, {"blocked", a.blocked},
          {"memory", a.memory}, {"fill", a.fill}, {"drain", a.drain}};
}

Json json_of(const CacheAccount& cache) {
  return {{"name", cache.name},
          {"lookups", cache.counts.lookups},
          {"misses", cache.counts.misses},
          {"line_bytes", cache.line_bytes}};
}

Json json_of(const Difference& d) {
  Json json{{"stage", d.stage},       {"x", d.x},          {"y", d.y},
            {"sample", d.sample},     {"cycle", d.cycle},  {"name", d.name},
            {"expected", d.expected}, {"actual", d.actual}};
  if (d.address >= 0) json["address"] = d.address;
  return json;
}

// Adds what the machine did: cycles, and the amounts that moved.
void add_counts(Json& json, const PictureReport& report) {
  json["cycles"] = report.all_cycles;
  json["cycles_of_last_frame"] = report.end.cycles;
  for (const PassCycles& pass : report.passes)
    json["passes"].push_back(Json{{"second", pass.second}, {"cycles", pass.cycles}});
  json["compared_numbers"] = report.compared;
  json["different_pixels"] = report.different_bytes;
  json["rays"] = report.rays;
  json["walk_steps"] = report.leaps;
  json["walk_samples"] = report.samples;
  json["samples"] = report.sampled;
  json["memory"] = {{"reads", report.memory.reads},
                    {"read_bytes", report.memory.read_bytes},
                    {"written_bytes", report.memory.written_bytes},
                    {"bus_cycles", report.memory.bus_cycles},
                    {"stored_bytes", report.memory_bytes}};
}

}  // namespace

Json json_of(const PictureReport& report, const Configuration& c) {
  Json json{{"good", report.good()}, {"configuration", json_of(c)}};
  add_counts(json, report);
  if (report.memory.dram) json["dram"] = memory_json(*report.memory.dram, *c.dram);
  if (!report.cost.channels.empty()) json["pipe"] = json_of(report.cost);
  json["uploads"] = Json::array();
  for (const UploadReport& upload : report.uploads) json["uploads"].push_back(json_of(upload));
  for (const StageAccount& stage : report.stages) json["stages"].push_back(json_of(stage));
  for (const CacheAccount& cache : report.caches) json["caches"].push_back(json_of(cache));
  if (report.good() && !report.stages.empty()) json["rays_per_cycle"] = bounds(report, c);
  if (report.difference) json["difference"] = json_of(*report.difference);
  if (report.strike)
    json["planted"] = {{"stage", report.strike->stage},
                       {"x", report.strike->x},
                       {"y", report.strike->y},
                       {"sample", report.strike->sample},
                       {"found_there", report.found_where_planted()}};
  return json;
}

std::string verdict_text(const PictureReport& report) {
  std::string text;
  if (report.difference) text += text_of(*report.difference);
  text += report.hang;
  if (report.strike)
    text += fmt::format("planted: {}, {}; {}\n", report.strike->stage, place_of(*report.strike),
                        report.good()                  ? "NOT FOUND"
                        : report.found_where_planted() ? "found there"
                                                       : "found, but ELSEWHERE");
  if (report.good())
    return text +
           fmt::format("{} numbers compared, and the bytes of the picture: no difference\n", report.compared);
  if (!report.difference) text += fmt::format("{} pixels of the picture differ\n", report.different_bytes);
  return text;
}

}  // namespace voxmelt::hwmodel::raycast
