#include "hwmodel/memory/import_dramsys.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hwmodel/memory/foreign_sheet.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel {
namespace {

using Json = nlohmann::json;

// The standard says this, but no file of DRAMSys does.
struct Standard {
  const char* name;
  int act_slots, column_slots, pre_slots, ref_slots;
  int after_reads;  // cycles without data before a write, beside its preamble
  bool late;        // data lie later by DQSCK and DQSS
};
constexpr Standard kStandards[] = {
    {"DDR3", 1, 1, 1, 1, 1, false}, {"DDR4", 1, 1, 1, 1, 1, false}, {"LPDDR4", 4, 4, 2, 2, 1, true}};
constexpr int kInterface = 20;  // ns

// Each key of a sheet, and what it may be called.
struct Renamed {
  const char* key;
  std::initializer_list<const char*> names;
};
const Renamed kTimes[] = {{"cl", {"RL"}},
                          {"cwl", {"WL"}},
                          {"rcd", {"RCD"}},
                          {"rp", {"RPpb", "RP"}},
                          {"rp_all", {"RPab", "RP"}},
                          {"ras", {"RAS"}},
                          {"rc", {"RCpb", "RC"}},
                          {"ccd_s", {"CCD_S", "CCD"}},
                          {"ccd_l", {"CCD_L", "CCD"}},
                          {"rrd_s", {"RRD_S", "RRD"}},
                          {"rrd_l", {"RRD_L", "RRD"}},
                          {"faw", {"FAW"}},
                          {"wr", {"WR"}},
                          {"wtr_s", {"WTR_S", "WTR"}},
                          {"wtr_l", {"WTR_L", "WTR"}},
                          {"rtp", {"RTP"}},
                          {"rfc", {"RFC1", "RFCab", "RFC"}},
                          {"refi", {"REFI"}},
                          {"rank_switch", {"RTRS"}}};

class Importer {
 public:
  Importer(const std::string& file, const Json& spec) : file_(file), spec_(spec), sheet_(file) {}

  scene::Value read() {
    const Standard& standard = standard_of_file();
    shape();
    times(standard);
    power();
    sheet_.title(text("memoryId"), "memoryId");
    return sheet_.document(parts_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw scene::InputError(file_ + ": error: " + what);
  }
  const Json& table(const std::string& name) const {
    const auto at = spec_.find(name);
    if (at == spec_.end() || !at->is_object()) fail("memspec." + name + " is missing");
    return *at;
  }
  std::string text(const char* key) const {
    const auto at = spec_.find(key);
    if (at == spec_.end() || !at->is_string())
      fail("memspec." + std::string(key) + " is missing, or no string");
    return at->get<std::string>();
  }
  bool has(const std::string& in, const std::string& key) const { return table(in).contains(key); }
  double number(const std::string& in, const std::string& key) const {
    const Json& from = table(in);
    if (!from.contains(key)) fail(in + "." + key + " is missing");
    if (!from[key].is_number()) fail(in + "." + key + " is not a number");
    return from[key].get<double>();
  }
  std::int64_t integer(const std::string& in, const std::string& key) const {
    const double value = number(in, key);
    if (value != std::floor(value) || std::abs(value) > 1e9)
      fail(in + "." + key + " = " + table(in)[key].dump() + " is not a whole number");
    return static_cast<std::int64_t>(value);
  }

  const Standard& standard_of_file() const {
    std::string names;
    const std::string type = text("memoryType");
    for (const Standard& standard : kStandards) {
      if (type == standard.name) return standard;
      names += (names.empty() ? "" : ", ") + std::string(standard.name);
    }
    fail("memoryType \"" + type + "\" is not read; there are " + names);
  }

  void shape() {
    const std::string in = "memarchitecturespec";
    const auto put = [&](const char* key, std::int64_t value, const char* name) {
      sheet_.put(key, value, in + "." + name);
    };
    const bool grouped = has(in, "nbrOfBankGroups");
    const std::int64_t groups = grouped ? integer(in, "nbrOfBankGroups") : 1,
                       banks = integer(in, "nbrOfBanks");
    if (groups < 1 || banks % groups != 0) fail(in + ".nbrOfBanks is no multiple of nbrOfBankGroups");
    if (has(in, "RefMode") && integer(in, "RefMode") != 1) fail(in + ".RefMode is not 1");
    parts_ = static_cast<int>(has(in, "nbrOfDevices") ? integer(in, "nbrOfDevices")
                                                      : integer(in, "nbrOfDevicesOnDIMM"));
    put("channels", integer(in, "nbrOfChannels"), "nbrOfChannels");
    put("ranks", integer(in, "nbrOfRanks"), "nbrOfRanks");
    put("groups", groups, "nbrOfBankGroups");
    put("banks", banks / groups, "nbrOfBanks");
    put("rows", integer(in, "nbrOfRows"), "nbrOfRows");
    put("columns", integer(in, "nbrOfColumns"), "nbrOfColumns");
    put("width_bits", integer(in, "width") * parts_, "width");
    put("transfers", integer(in, "burstLength"), "burstLength");
    put("data_rate", integer(in, "dataRate"), "dataRate");
  }

  void times(const Standard& standard) {
    const std::string in = "memtimingspec";
    const auto named = [&](const char* key, const char* name) {
      sheet_.put(key, integer(in, name), in + "." + name);
    };
    const auto put = [&](const char* key, std::int64_t value, const char* where) {
      sheet_.put(key, value, where);
    };
    const double mhz = has(in, "clkMhz") ? number(in, "clkMhz") : 1e-6 / number(in, "tCK");
    put("mhz", std::llround(mhz), has(in, "clkMhz") ? "memtimingspec.clkMhz" : "memtimingspec.tCK");
    for (const Renamed& time : kTimes) {
      const char* name = nullptr;
      for (const char* candidate : time.names)
        if (name == nullptr && has(in, candidate)) name = candidate;
      named(time.key, name == nullptr ? *time.names.begin() : name);
    }
    if (has(in, "PPD")) named("ppd", "PPD");
    put("read_more", standard.late ? integer(in, "DQSCK") : 0, "memtimingspec.DQSCK");
    put("write_more", standard.late ? integer(in, "DQSS") : 0, "memtimingspec.DQSS");
    const std::int64_t preamble = has(in, "WPRE") ? integer(in, "WPRE") : 1;
    put("read_to_write", preamble + standard.after_reads, "memtimingspec.WPRE");
    put("act_slots", standard.act_slots, standard.name);
    put("column_slots", standard.column_slots, standard.name);
    put("pre_slots", standard.pre_slots, standard.name);
    put("ref_slots", standard.ref_slots, standard.name);
    put("interface_cycles", std::llround(kInterface * mhz / 1000), "20 ns");
  }

  // Currents are in amperes there. A supply without them has zeros, and is left out.
  void power() {
    const std::string in = "mempowerspec";
    if (!spec_.contains(in)) return;
    struct Supply {
      const char *name, *volts, *current, *end, *refresh;
    };
    constexpr Supply kSupplies[] = {{"VDD", "vdd", "idd", "", "5B"},
                                    {"VPP", "vpp", "ipp", "", "5B"},
                                    {"VDD1", "vdd1", "idd", "1", "5"},
                                    {"VDD2", "vdd2", "idd", "2", "5"}};
    for (const Supply& supply : kSupplies) {
      const std::string first = std::string(supply.current) + "0" + supply.end;
      if (!has(in, supply.volts) || !has(in, first) || number(in, first) == 0) continue;
      std::vector<ForeignSheet::Number> numbers{{"volts", number(in, supply.volts), in + "." + supply.volts}};
      for (const char* which : {"0", "2n", "3n", "4r", "4w", "5"}) {
        const std::string name =
            supply.current + std::string(which == std::string("5") ? supply.refresh : which) + supply.end;
        numbers.push_back({"idd" + std::string(which), 1000 * number(in, name), in + "." + name});
      }
      sheet_.rail(supply.name, numbers);
    }
  }

  std::string file_;
  const Json& spec_;
  ForeignSheet sheet_;
  int parts_ = 1;
};

}  // namespace

scene::Value import_dramsys(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw scene::InputError(file + ": error: cannot be read");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  Json root;
  try {
    root = Json::parse(text, nullptr, true, true);
  } catch (const Json::exception& error) {
    throw scene::InputError(file + ": error: no JSON: " + error.what());
  }
  if (!root.is_object() || !root.contains("memspec") || !root["memspec"].is_object())
    throw scene::InputError(file + ": error: memspec is missing; DRAMSys describes a memory there");
  return Importer(file, root["memspec"]).read();
}

}  // namespace voxmelt::hwmodel
