#include "hwmodel/explore/device.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "hwmodel/explore/family.h"
#include "hwmodel/explore/read_file.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel::explore {
namespace {

constexpr std::string_view kOfFamily = "family.";

}  // namespace

Amounts Device::usable() const {
  Amounts result{};
  for (const Resource r : kEachResource) result[r] = amounts[r] - shell[r];
  for (const Resource logic : {kLut, kFf})
    result[logic] =
        static_cast<std::int64_t>(std::floor(static_cast<double>(result[logic]) * fill.value + 1e-9));
  return result;
}

namespace {

void read_shell(scene::Reader& root, Device& d) {
  std::optional<scene::Reader> from = root.table("shell");
  if (!from) return;
  for (std::size_t r = 0; r < kResources; ++r)
    d.shell[r] = from->integer(kResourceNames[r], 0, d.amounts[r], 0);
  d.shell_source = from->text("source");
  from->finish();
}

}  // namespace

Device load_device(const std::string& name, const std::vector<std::string>& overrides) {
  std::vector<std::string> of_family, of_device;
  for (const std::string& set : overrides)
    if (set.starts_with(kOfFamily))
      of_family.push_back(set.substr(kOfFamily.size()));
    else
      of_device.push_back(set);
  scene::Value document = read_file(device_files(), "devices", name, "--device " + name, "device");
  const Given given = override_file(document, of_device);
  Device d;
  d.name = name;
  scene::Reader root(document, "");
  d.title = root.text("title", "");
  scene::Reader from = table_of(root, "device");
  from.knows(std::array{"family", "lut", "ff", "dsp", "bram", "uram", "lutram", "clock", "clock_range",
                        "clock_source", "fill", "fill_range", "fill_source", "chain", "link",
                        "link_latency"});
  const std::string family = from.text("family");
  for (std::size_t r = 0; r < kResources; ++r) d.amounts[r] = from.integer(kResourceNames[r], 0, kMostUnits);
  d.lutram = from.integer("lutram", 0, kMostUnits);
  from.integer("clock", 1, 10000);  // it is whole
  const Ranged<double> clock = read_of_device(from, "clock", 1, 10000, given);
  const auto mhz = [](double number) { return static_cast<int>(std::lround(number)); };
  d.clock_mhz = {mhz(clock.value), mhz(clock.low), mhz(clock.high), clock.source};
  d.fill = read_of_device(from, "fill", 0.01, 1, given);
  d.chain = from.integer("chain", 1, 64, 1);
  d.link_gbit = from.integer("link", 1, 100'000, d.link_gbit);
  d.link_ns = from.integer("link_latency", 0, 1'000'000, d.link_ns);
  from.finish();
  read_shell(root, d);
  root.finish();
  d.family = load_family(family, from.place("family").text(), of_family);
  return d;
}

}  // namespace voxmelt::hwmodel::explore
