#include "hwmodel/memory/import_ramulator.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hwmodel/memory/foreign_sheet.h"
#include "hwmodel/memory/yaml_subset.h"
#include "kernel/scene/text/error.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {
namespace {

// JESD79-4 says this of a data rate, in cycles. Parts of 4 and 8 bits have one pair of tRRD, those of 16 bits
// another, and each width has its tFAW.
struct Rate {
  int mts, ras, wr, rtp, cwl, ccd_l, wtr_s, wtr_l;
  int rrd_s_of_16, rrd_l, rrd_l_of_16;
  std::array<int, 3> faw;  // parts of 4, 8 and 16 bits
};
constexpr Rate kRates[] = {{1600, 28, 12, 6, 9, 5, 2, 6, 5, 5, 6, {16, 20, 28}},
                           {1866, 32, 14, 7, 10, 5, 3, 7, 5, 5, 6, {16, 22, 28}},
                           {2133, 36, 16, 8, 11, 6, 3, 8, 6, 6, 7, {16, 23, 32}},
                           {2400, 39, 18, 9, 12, 6, 3, 9, 7, 6, 8, {16, 26, 36}},
                           {2666, 43, 20, 10, 14, 7, 4, 10, 8, 7, 9, {16, 28, 40}},
                           {2933, 47, 22, 11, 16, 8, 4, 11, 8, 8, 10, {16, 31, 44}},
                           {3200, 52, 24, 12, 16, 8, 4, 12, 9, 8, 11, {16, 34, 48}}};
// The grade says CL, tRCD and tRP, which are the same. Ramulator calls 17 of DDR4-2400 U and 18 T.
const std::map<std::string, int, std::less<>> kGrades{
    {"1600J", 10}, {"1600K", 11}, {"1600L", 12},  {"1866L", 12}, {"1866M", 13},  {"1866N", 14},
    {"2133N", 14}, {"2133P", 15}, {"2133R", 16},  {"2400P", 15}, {"2400R", 16},  {"2400U", 17},
    {"2400T", 18}, {"2666T", 17}, {"2666U", 18},  {"2666V", 19}, {"2666W", 20},  {"2933V", 19},
    {"2933W", 20}, {"2933Y", 21}, {"2933AA", 22}, {"3200W", 20}, {"3200AA", 22}, {"3200AC", 24}};
const std::map<int, int> kRefresh{{2048, 160}, {4096, 260}, {8192, 360}, {16384, 550}};  // Mb of a part; ns
constexpr int kInterval = 7800, kInterface = 20;                                         // ns

// Rounds up, but for the last 2.6 % of a cycle, as JESD79-4 says.
std::int64_t cycles_of(double ns, int tck_ps) {
  return (std::llround(1000 * ns) * 1000 / tck_ps + 974) / 1000;
}

class Importer {
 public:
  Importer(const std::string& file, scene::Reader& dram) : file_(file), dram_(dram), sheet_(file) {}

  scene::Value read() {
    if (dram_.text("impl") != "DDR4")
      dram_.fail("impl", " = \"" + dram_.text("impl") + "\" is not read; only DDR4 is");
    scene::Reader org = table("org"), timing = table("timing");
    shape(org);
    times(timing);
    org.finish();
    timing.finish();
    sheet_.title("DDR4-" + std::to_string(rate_) + " of " + file_, "title");
    return sheet_.document(1);
  }

 private:
  scene::Reader table(const char* name) const {
    std::optional<scene::Reader> found = dram_.table(name);
    if (!found) dram_.fail(name, " is missing");
    return *found;
  }

  // A preset such as DDR4_8Gb_x8 says the parts; numbers beside it go before it.
  void shape(scene::Reader& org) {
    const std::string preset = org.text("preset", "");
    std::optional<int> density, dq, groups, banks, rows, columns;
    if (!preset.empty()) {
      int gigabits = 0, width = 0;
      for (const auto& [megabits, ns] : kRefresh)
        for (const int bits : {4, 8, 16})
          if (preset == "DDR4_" + std::to_string(megabits / 1024) + "Gb_x" + std::to_string(bits)) {
            gigabits = megabits / 1024;
            width = bits;
          }
      if (gigabits == 0) org.fail("preset", " = \"" + preset + "\" is not known");
      density = 1024 * gigabits;
      dq = width;
      groups = width == 16 ? 2 : 4;
      banks = 4;
      columns = 1024;
      rows = (1024 * gigabits / width) * (1 << 20) / 1024 / (*groups * *banks);
    }
    const auto number = [&](const char* key, int most, std::optional<int> missing) {
      return org.integer(key, 1, most, missing);
    };
    density_ = number("density", 1 << 16, density);
    dq_ = number("dq", 64, dq);
    const int width = number("channel_width", 512, 64);
    const auto put = [&](const char* key, int value, const char* name) {
      sheet_.put(key, value, std::string("org.") + name);
    };
    put("channels", number("channel", 64, 1), "channel");
    put("ranks", number("rank", 8, 1), "rank");
    put("groups", number("bankgroup", 64, groups), "bankgroup");
    put("banks", number("bank", 64, banks), "bank");
    put("rows", number("row", 1 << 20, rows), "row");
    put("columns", number("column", 1 << 14, columns), "column");
    put("width_bits", width, "channel_width");
    put("transfers", 8, "channel_width");
    put("data_rate", 2, "channel_width");
  }

  // Finds what a preset such as DDR4_2400R says, or what is known of a rate alone.
  struct Known {
    const Rate* rate = nullptr;
    std::optional<int> cl;
  };
  Known known_of(scene::Reader& timing) {
    const std::string preset = timing.text("preset", "");
    Known known;
    if (preset.empty()) {
      rate_ = timing.integer("rate", 100, 10000);
    } else {
      const auto grade =
          preset.starts_with("DDR4_") ? kGrades.find(std::string_view(preset).substr(5)) : kGrades.end();
      if (grade == kGrades.end()) timing.fail("preset", " = \"" + preset + "\" is not known");
      known.cl = grade->second;
      std::from_chars(grade->first.data(), grade->first.data() + grade->first.size(),
                      rate_);  // the letters end it
    }
    const auto* const at =
        std::find_if(std::begin(kRates), std::end(kRates), [&](const Rate& r) { return r.mts == rate_; });
    if (at != std::end(kRates)) known.rate = at;
    return known;
  }

  void times(scene::Reader& timing) {
    const Known known = known_of(timing);
    const Rate* rate = known.rate;
    const int tck_ps = 2'000'000 / rate_;
    const auto preset = [&](int Rate::*number_of_rate) {
      return rate == nullptr ? std::nullopt : std::optional(rate->*number_of_rate);
    };
    // A number is given in cycles (nRCD) or in ns (tRCD), or the preset has it.
    const auto number = [&](const std::string& name, std::optional<int> missing) {
      const std::string in_ns = "t" + name;
      if (timing.has(in_ns))
        return static_cast<int>(cycles_of(timing.number(in_ns, {.lowest = 0, .highest = 1e6}), tck_ps));
      return timing.integer("n" + name, 1, 1 << 24, missing);
    };
    const auto put = [&](const char* key, const char* name, std::optional<int> missing) {
      const int value = number(name, missing);
      sheet_.put(key, value, std::string("timing.n") + name);
      return value;
    };
    sheet_.put("mhz", rate_ / 2, "timing.rate");
    if (number("BL", 4) != 4) timing.fail("nBL", " is not 4");
    put("cl", "CL", known.cl);
    put("rcd", "RCD", known.cl);
    const int rp = put("rp", "RP", known.cl);
    sheet_.put("rp_all", rp, "timing.nRP");
    const int ras = put("ras", "RAS", preset(&Rate::ras));
    put("rc", "RC", ras + rp);
    put("wr", "WR", preset(&Rate::wr));
    put("rtp", "RTP", preset(&Rate::rtp));
    put("cwl", "CWL", preset(&Rate::cwl));
    put("ccd_s", "CCDS", 4);
    put("ccd_l", "CCDL", preset(&Rate::ccd_l));
    put("wtr_s", "WTRS", preset(&Rate::wtr_s));
    put("wtr_l", "WTRL", preset(&Rate::wtr_l));
    const bool wide = dq_ == 16;
    put("rrd_s", "RRDS", wide ? preset(&Rate::rrd_s_of_16) : std::optional(4));
    put("rrd_l", "RRDL", preset(wide ? &Rate::rrd_l_of_16 : &Rate::rrd_l));
    put("faw", "FAW",
        rate == nullptr ? std::nullopt
                        : std::optional(rate->faw[dq_ == 4   ? 0
                                                  : dq_ == 8 ? 1
                                                             : 2]));
    const auto refresh = kRefresh.find(density_);
    put("rfc", "RFC",
        refresh == kRefresh.end() ? std::nullopt
                                  : std::optional(static_cast<int>(cycles_of(refresh->second, tck_ps))));
    put("refi", "REFI", static_cast<int>(cycles_of(kInterval, tck_ps)));
    put("rank_switch", "CS", 2);
    const auto assume = [&](const char* key, int value) { sheet_.put(key, value, "assumed for DDR4"); };
    assume("read_to_write", 2);  // nCL + nBL + 2 - nCWL between the commands there
    for (const char* key : {"read_more", "write_more"}) assume(key, 0);
    for (const char* key : {"act_slots", "column_slots", "pre_slots", "ref_slots"}) assume(key, 1);
    assume("interface_cycles", kInterface * rate_ / 2 / 1000);
  }

  std::string file_;
  scene::Reader& dram_;
  ForeignSheet sheet_;
  int density_ = 0, dq_ = 0, rate_ = 0;  // Mb of a part, its bits, millions of transfers a second
};

}  // namespace

scene::Value import_ramulator(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw scene::InputError(file + ": error: cannot be read");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const scene::Value document =
      parse_yaml_subset(text, std::make_shared<const scene::Origin>(scene::Origin{file, {}, false}));
  scene::Reader root(document, "");
  std::optional<scene::Reader> system = root.table("MemorySystem");
  if (!system) root.fail("MemorySystem", " is missing");
  std::optional<scene::Reader> dram = system->table("DRAM");
  if (!dram) system->fail("DRAM", " is missing");
  return Importer(file, *dram).read();
}

}  // namespace voxmelt::hwmodel
