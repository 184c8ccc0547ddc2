// The tables here are about a device: what it can do, whole steps, what takes most of them, and what goes to
// and fro.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "measure/texts.h"
#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

constexpr std::size_t kLongest = 3;  // kernels of a row

std::string begin(const char* name, const std::string& head) {
  return fmt::format("<!-- table: {} -->\n{}\n", name, head);
}

std::string machine_table(const DeviceMachine& device) {
  return begin("device",
               "| device | driver | memory, GiB | it copies, GB/s | a launch, microseconds |\n"
               "|---|---|--:|--:|--:|") +
         fmt::format("| {} | {} | {} | {} | {} |\n\n", device.name, device.driver,
                     three_digits(static_cast<double>(device.memory) / (std::uint64_t{1} << 30)),
                     three_digits(device.copy / 1e9), three_digits(device.launch * 1e6));
}

std::string longest_of(const DeviceCase& one) {
  std::string text;
  for (std::size_t k = 0; k < std::min(kLongest, one.kernels.size()); ++k)
    text +=
        fmt::format("{}{} {}", k == 0 ? "" : ", ", one.kernels[k].name, milliseconds(one.kernels[k].seconds));
  return text;
}

std::string steps_table(const Findings& findings) {
  std::string text =
      begin("devicesteps",
            "| workload | grid | ms a step | Mcells/s, active | of the copy | launches | of the "
            "step | longest kernels, ms | a processor, ms | times as long | visibility, ms | in a run, ms |\n"
            "|---|---|--:|--:|--:|--:|--:|---|---|--:|--:|--:|");
  for (const DeviceCase& one : findings.device_cases)
    text += fmt::format("| `{}` | {} x {} x {} | {} | {} | {} % | {} | {} % | {} | {}: {} | {} | {} | {} |\n",
                        one.workload, one.grid.x, one.grid.y, one.grid.z, milliseconds(one.seconds),
                        three_digits(static_cast<double>(one.active) / one.seconds / 1e6),
                        three_digits(one.percent_of_copy()), three_digits(one.launches),
                        three_digits(one.percent_of_launches()), longest_of(one),
                        one.processor.implementation->name, milliseconds(one.processor_seconds),
                        three_digits(one.times_processor()),
                        one.rays > 0 ? milliseconds(one.visibility) : "none", milliseconds(one.as_run));
  return text + "\n";
}

std::string transfers_table(const Findings& findings) {
  std::string text = begin("transfers",
                           "| workload | state there, ms | MB | masks back, ms | MB | state back, ms | MB |\n"
                           "|---|--:|--:|--:|--:|--:|--:|");
  const auto cells = [](const Transfer& one) {
    return fmt::format(" {} | {} |", milliseconds(one.seconds),
                       three_digits(static_cast<double>(one.bytes) / 1e6));
  };
  for (const DeviceCase& one : findings.device_cases)
    text += fmt::format("| `{}` |{}{}{}\n", one.workload, cells(one.upload), cells(one.masks),
                        cells(one.download));
  return text + "\n";
}

std::string device_pictures_table(const Findings& findings) {
  std::string text = begin(
      "devicepictures",
      "| workload | pixels | a picture, ms | of it to draw | launches | fetched, MB | a processor, ms |\n"
      "|---|---|--:|--:|--:|--:|--:|");
  for (const DeviceCase& one : findings.device_cases)
    if (const auto& picture = one.picture)
      text += fmt::format("| `{}` | {} x {} | {} | {} | {} | {} | {} |\n", one.workload, picture->width,
                          picture->height, milliseconds(picture->seconds()), milliseconds(picture->draw),
                          picture->launches, three_digits(static_cast<double>(picture->fetched) / 1e6),
                          milliseconds(picture->processor));
  return text + "\n";
}

}  // namespace

std::string device_tables(const Findings& findings) {
  if (!findings.device) return "";
  return machine_table(*findings.device) + steps_table(findings) + transfers_table(findings) +
         device_pictures_table(findings);
}

}  // namespace voxmelt::measure
