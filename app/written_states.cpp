#include "app/written_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/link_or_copy.h"
#include "app/message.h"
#include "app/moment.h"
#include "app/print.h"
#include "kernel/run/io/csv.h"
#include "kernel/run/io/export.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/io/vti.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStates = "states";
constexpr std::string_view kTable = "csv";
constexpr const char* kSeries = "states.pvd";

bool has(const RunRecord& record, bool table) {
  return std::ranges::any_of(record.write,
                             [&](const std::string& name) { return (name == kTable) == table; });
}

// Tells if the states are VTK images, which a file of kSeries lists for ParaView.
bool has_series(const RunRecord& record) {
  return std::ranges::find(record.write, "vti") != record.write.end();
}

// Tells if a format asks for the surface of the pictures.
bool wants_drawn(const RunRecord& record) {
  return record.surface != "cells" && std::ranges::any_of(record.write, [](const std::string& name) {
           return io::find_format(name)->of_surface;
         });
}

fs::path folder_of(const fs::path& folder, std::uint32_t step) {
  return folder / kStates / fmt::format("step_{:05}", step);
}

std::string text_of(const fs::path& file) {
  const std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  return text.str();
}

// Returns the number with which a row begins, or the largest one if it begins with a word.
std::uint32_t step_of(std::string_view row) {
  std::uint32_t step = UINT32_MAX;
  std::from_chars(row.data(), row.data() + row.size(), step);
  return step;
}

std::uint32_t step_of_folder(const std::string& name) {
  return step_of(name.starts_with("step_") ? name.substr(5) : name);
}

// Lists the images of all states, with the step of each as its time.
std::string series_of(const fs::path& folder) {
  std::map<std::uint32_t, std::string> images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kStates)) {
    const std::string name = entry.path().filename().string();
    if (fs::exists(entry.path() / io::kVtiFile)) images[step_of_folder(name)] = name;
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n";
  for (const auto& [step, name] : images)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}/{}/{}\"/>\n", step, kStates, name,
                        io::kVtiFile);
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace

std::string format_list() {
  std::string list;
  for (const io::Format& format : io::formats())
    list += fmt::format("{}{}: {}", list.empty() ? "" : "; ", format.name, format.description);
  return list;
}

void check_format(const std::string& name, const std::string& option) {
  const io::Format* const format = io::find_format(name);
  const std::string missing = format != nullptr && format->missing != nullptr ? format->missing() : "";
  if (!missing.empty()) throw UsageError(fmt::format("{} {}: error: {}", option, name, missing));
}

std::vector<std::string> formats_named(const std::string& list) {
  std::vector<std::string> names;
  if (list.empty()) return names;
  std::istringstream words(list + ",");
  for (std::string name; std::getline(words, name, ',');) {
    std::string known;
    for (const io::Format& format : io::formats())
      known += (known.empty() ? "" : ", ") + std::string(format.name);
    if (io::find_format(name) == nullptr)
      throw UsageError(fmt::format("--write {}: error: '{}' is not one of {}", list, name, known));
    if (std::ranges::find(names, name) != names.end())
      throw UsageError(fmt::format("--write {}: error: {} comes twice", list, name));
    check_format(name, "--write");
    names.push_back(name);
  }
  return names;
}

WrittenStates::WrittenStates(const RunRecord& record, fs::path folder, std::uint32_t begun_at)
    : record_(record), folder_(std::move(folder)), last_step_(begun_at) {
  if (has(record_, true)) rows_ = text_of(folder_ / io::kCsvFile);
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / kStates, none))
    states_ += entry.is_directory() ? 1 : 0;
  settled_ = states_ == 0;
}

void WrittenStates::add(const run::Simulation& simulation, const scene::Scene& scene) {
  const std::uint32_t step = simulation.steps_done();
  if (!write_is_due(record_, step)) return;
  io::Moment moment = moment_of(simulation, scene);
  const std::chrono::duration<double> passed = Clock::now() - last_;
  if (step > last_step_) moment.seconds_per_step = passed.count() / (step - last_step_);
  if (has(record_, true)) {
    rows_ += (rows_.empty() ? io::csv_head() : "") + io::csv_row(moment);
  }
  settled_ = false;
  if (has(record_, false)) {
    const fs::path folder = folder_of(folder_, step);
    io::make_folder(folder);
    if (wants_drawn(record_))
      moment.surface = surface_.of(simulation.volume(), scene, thread_count(record_.common));
    for (const std::string& name : record_.write)
      if (name != kTable) io::find_format(name)->write(moment, folder, {});
    io::flush_folder(folder);
    ++states_;
  }
  last_ = Clock::now();
  last_step_ = step;
}

void WrittenStates::settle() {
  if (!settled_ && !rows_.empty()) io::write_file(folder_ / io::kCsvFile, rows_);
  if (!settled_ && has_series(record_) && states_ > 0) io::write_file(folder_ / kSeries, series_of(folder_));
  settled_ = true;
}

void WrittenStates::print_place(const std::string& place) const {
  if (!rows_.empty()) print("table          {}/{}\n", place, io::kCsvFile);
  if (states_ > 0) print("{} states      {}/{}/\n", states_, place, kStates);
  if (states_ > 0 && has_series(record_)) print("for ParaView   {}/{}\n", place, kSeries);
}

void take_over_written(const fs::path& from, const fs::path& to, const RunRecord& record,
                       std::uint32_t step) {
  std::istringstream old(text_of(from / io::kCsvFile));
  std::string rows;
  for (std::string row; has(record, true) && std::getline(old, row);) {
    const std::uint32_t written = step_of(row);
    if (rows.empty() || (written <= step && write_is_due(record, written))) rows += row + "\n";
  }
  if (!rows.empty()) io::write_file(to / io::kCsvFile, rows);

  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(from / kStates, none)) {
    const std::string name = entry.path().filename().string();
    const std::uint32_t written = step_of_folder(name);
    if (written > step || !write_is_due(record, written)) continue;
    const fs::path folder = to / kStates / name;
    io::make_folder(folder);
    for (const fs::directory_entry& file : fs::directory_iterator(entry.path()))
      link_or_copy(file.path(), folder / file.path().filename());
    io::flush_folder(folder);
  }
}

}  // namespace voxmelt::app
