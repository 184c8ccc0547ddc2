#include "hwmodel/memory/sheet.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include "hwmodel/memory/energy.h"
#include "hwmodel/memory/import_dramsys.h"
#include "hwmodel/memory/import_ramulator.h"
#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/document.h"
#include "kernel/scene/text/error.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {
namespace {

constexpr int kMostBanks = 64;  // banks of a channel: the controller keeps a bit of each

int power_of_two(scene::Reader& from, const char* key, int high, std::optional<int> missing = {}) {
  const int value = from.integer(key, 1, high, missing);
  if (!std::has_single_bit<unsigned>(value))
    from.fail(key, " = " + std::to_string(value) + " is not a power of 2");
  return value;
}

// All keys of [memory], which are so short that each looks like a misspelling of others.
constexpr const char* kKeys[] = {"mhz",
                                 "data_rate",
                                 "channels",
                                 "ranks",
                                 "groups",
                                 "banks",
                                 "rows",
                                 "columns",
                                 "width_bits",
                                 "transfers",
                                 "cl",
                                 "cwl",
                                 "read_more",
                                 "write_more",
                                 "rcd",
                                 "rp",
                                 "rp_all",
                                 "ras",
                                 "rc",
                                 "ccd_s",
                                 "ccd_l",
                                 "ccd_l_write",
                                 "rrd_s",
                                 "rrd_l",
                                 "faw",
                                 "wr",
                                 "wtr_s",
                                 "wtr_l",
                                 "rtp",
                                 "ppd",
                                 "read_to_write",
                                 "rank_switch",
                                 "rfc",
                                 "refi",
                                 "refresh",
                                 "groups_at_once",
                                 "refi_bank",
                                 "rfc_bank",
                                 "ref_to_ref",
                                 "ref_to_act",
                                 "act_slots",
                                 "column_slots",
                                 "pre_slots",
                                 "ref_slots",
                                 "two_buses",
                                 "interface_cycles"};

void read_shape(scene::Reader& from, memory::Parameters& p) {
  p.channels = power_of_two(from, "channels", 64);
  p.ranks = power_of_two(from, "ranks", 8);
  p.groups = power_of_two(from, "groups", 16);
  p.banks = power_of_two(from, "banks", 32);
  p.rows = power_of_two(from, "rows", 1 << 20);
  p.columns = power_of_two(from, "columns", 1 << 14);
  p.width_bits = power_of_two(from, "width_bits", 512);
  p.transfers = power_of_two(from, "transfers", 64);
  if (p.ranks * p.groups * p.banks > kMostBanks)
    from.fail("banks", ": a channel has more than " + std::to_string(kMostBanks) + " banks");
  p.data_rate = power_of_two(from, "data_rate", 16, 2);
  if (p.width_bits < 8 || p.transfers < p.data_rate || p.column_bytes() > memory::kBurst)
    from.fail("transfers", ": a burst must have whole bytes, and 64 of them at most, and take whole cycles");
  if (p.row_bytes() < memory::kBurst) from.fail("columns", ": a row must have 64 bytes");
}

// A sheet has all of the numbers, or none.
void read_bank_refresh(scene::Reader& from, memory::Parameters& p) {
  p.by_bank = from.choice("refresh", {"all", "bank"}, 0) == 1;
  const auto named = {"groups_at_once", "refi_bank", "rfc_bank", "ref_to_ref", "ref_to_act"};
  if (!p.by_bank && std::none_of(named.begin(), named.end(), [&](const char* key) { return from.has(key); }))
    return;
  p.groups_at_once = power_of_two(from, "groups_at_once", p.groups);
  p.rfc_bank = from.integer("rfc_bank", 1, 10000);
  p.ref_to_ref = from.integer("ref_to_ref", 1, 10000);
  p.ref_to_act = from.integer("ref_to_act", 1, 10000);
  // Other banks must have time for their requests.
  const int least = std::max(2 * p.ref_to_ref, 2 * (p.rfc_bank + p.ras + p.rp) / p.refreshes_of_rank());
  p.refi_bank = from.integer("refi_bank", least, 10'000'000);
}

void read_cycles(scene::Reader& from, memory::Parameters& p) {
  const auto cycles = [&](const char* key, int low, int high) { return from.integer(key, low, high); };
  constexpr int kMost = 10000;
  p.cl = cycles("cl", 1, kMost);
  p.cwl = cycles("cwl", 1, kMost);
  p.read_more = cycles("read_more", 0, kMost);
  p.write_more = cycles("write_more", 0, kMost);
  p.rcd = cycles("rcd", 1, kMost);
  p.rp = cycles("rp", 1, kMost);
  p.rp_all = cycles("rp_all", 1, kMost);
  p.ras = cycles("ras", 1, kMost);
  p.rc = cycles("rc", p.ras, kMost);
  p.ccd_s = cycles("ccd_s", p.beats(), kMost);
  p.ccd_l = cycles("ccd_l", p.ccd_s, kMost);
  p.ccd_l_write = from.integer("ccd_l_write", p.ccd_s, kMost, p.ccd_l);
  p.rrd_s = cycles("rrd_s", 1, kMost);
  p.rrd_l = cycles("rrd_l", p.rrd_s, kMost);
  p.faw = cycles("faw", 1, kMost);
  p.wr = cycles("wr", 1, kMost);
  p.wtr_s = cycles("wtr_s", 1, kMost);
  p.wtr_l = cycles("wtr_l", p.wtr_s, kMost);
  p.rtp = cycles("rtp", 1, kMost);
  p.ppd = from.integer("ppd", 0, kMost, 0);
  p.read_to_write = cycles("read_to_write", 0, kMost);
  p.rank_switch = cycles("rank_switch", 0, kMost);
  // A refresh must leave time for requests.
  p.rfc = cycles("rfc", 1, kMost);
  p.refi = cycles("refi", 2 * (p.rfc + p.ras + p.rp_all), 1000 * kMost);
  read_bank_refresh(from, p);
  p.act_slots = cycles("act_slots", 1, 16);
  p.column_slots = cycles("column_slots", 1, 16);
  p.pre_slots = cycles("pre_slots", 1, 16);
  p.ref_slots = cycles("ref_slots", 1, 16);
  p.two_buses = from.flag("two_buses", false);
  p.interface_cycles = cycles("interface_cycles", 0, kMost);
}

void read_rails(scene::Reader& root, memory::Parameters& p) {
  std::optional<scene::Reader> power = root.table("power");
  if (!power) return;
  p.parts = power->integer("parts", 1, 64);
  std::vector<scene::Reader> rails = power->tables("rail");
  if (rails.empty()) power->fail("rail", ": there is no supply");
  for (scene::Reader& from : rails) {
    const auto current = [&](const char* key, double lowest) {
      return from.number(key, {.lowest = lowest, .highest = 10000});
    };
    memory::Rail rail;
    rail.name = from.text("name");
    rail.volts = from.number("volts", {.lowest = 0.1, .highest = 10});
    rail.idd2n = current("idd2n", 0);
    rail.idd3n = current("idd3n", rail.idd2n);
    rail.idd0 = current("idd0", memory::standby_of_a_row(rail, p));
    rail.idd4r = current("idd4r", rail.idd3n);
    rail.idd4w = current("idd4w", rail.idd3n);
    rail.idd5 = current("idd5", rail.idd3n);
    from.finish();
    p.rails.push_back(rail);
  }
  power->finish();
}

struct Format {
  const char* end;
  scene::Value (*read)(const std::string& file);
};
constexpr Format kFormats[] = {{".toml", [](const std::string& file) { return scene::parse_file(file); }},
                               {".json", import_dramsys},
                               {".yaml", import_ramulator}};

scene::Value document_of(const std::string& name, const std::string& place) {
  for (const Format& format : kFormats)
    if (name.ends_with(format.end)) return format.read(name);
  const std::vector<MemoryFile>& files = memory_files();
  const auto at =
      std::find_if(files.begin(), files.end(), [&](const MemoryFile& file) { return file.name == name; });
  if (at != files.end())
    return scene::parse_text(at->text, std::make_shared<const scene::Origin>(scene::Origin{
                                           "hwmodel/memory/sheets/" + name + ".toml", {}, false}));
  std::string known = "fixed";
  for (const MemoryFile& file : files) known += ", " + file.name;
  throw scene::InputError(place + ": error: no memory \"" + name + "\"; there are " + known +
                          ", or a file that ends in .toml, .json or .yaml");
}

}  // namespace

bool is_memory_file(const std::string& name) {
  return std::any_of(std::begin(kFormats), std::end(kFormats),
                     [&](const Format& format) { return name.ends_with(format.end); });
}

memory::Parameters load_memory(const std::string& name, const std::string& place,
                               const std::vector<std::string>& overrides) {
  scene::Value document = document_of(name, place);
  for (const std::string& assignment : overrides) scene::apply_override(document, assignment);
  memory::Parameters p;
  p.name = name;
  scene::Reader root(document, "");
  p.title = root.text("title", "");
  std::optional<scene::Reader> from = root.table("memory");
  if (!from) root.fail("memory", ": the file has no such table");
  from->knows(kKeys);
  p.mhz = from->integer("mhz", 1, 100000);
  read_shape(*from, p);
  read_cycles(*from, p);
  from->finish();
  read_rails(root, p);
  root.finish();
  return p;
}

}  // namespace voxmelt::hwmodel
