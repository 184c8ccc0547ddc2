#include "app/runs/gather.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "app/message.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/scene/text/text_file.h"
#include "report/runs/steps_table.h"
#include "report/runs/sweep_page.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

constexpr const char* kSections[] = {"cells", "mass", "energy", "heat"};

// Returns the report of a complete run, or nothing.
std::optional<json> report_of(const fs::path& folder) {
  std::ifstream file(folder / "report.json");
  json report = json::parse(file, nullptr, false);
  if (!report.is_object() || report.value("complete", json()) != true) return std::nullopt;
  return report;
}

std::string word_of(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// A value with a comma, a quote or a line end stands in quotes.
std::string csv_word(const std::string& word) {
  if (word.find_first_of(",\"\n\r") == std::string::npos) return word;
  std::string quoted = "\"";
  for (const char c : word) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// Strings are shown without their quotes.
std::string shown(const AxisValue& value) {
  const bool quoted = value.text.size() > 1 && value.text.front() == '"';
  return quoted ? value.text.substr(1, value.text.size() - 2) : value.text;
}

class Table {
 public:
  explicit Table(const Plan& plan) : head_("run") {
    for (const Axis& axis : plan.axes) head_.append(1, ',').append(csv_word(axis.key));
    head_ += ",steps,digest";
  }
  void add(const PlannedRun& run, const json& report) {
    std::string row = csv_word(run.name), names;
    const auto put = [&](const std::string& word) { row.append(1, ',').append(csv_word(word)); };
    for (const AxisValue& value : run.values) put(shown(value));
    put(word_of(report.value("steps", json())));
    put(word_of(report.value("digest", json())));
    for (const char* section : kSections) {
      const json numbers = report.value(section, json::object());
      for (const auto& [name, value] : numbers.items()) {
        names += fmt::format(",{}_{}", section, name);
        put(word_of(value));
      }
    }
    if (rows_.empty()) head_ += names + ",seconds\n";
    const json seconds = report.value("seconds", json::object()).value("total", json(0.0));
    rows_ += fmt::format("{},{:.3f}\n", row, seconds.is_number() ? seconds.get<double>() : 0);
  }
  std::string text() const { return rows_.empty() ? head_ + "\n" : head_ + rows_; }

 private:
  std::string head_, rows_;
};

double number_at(const json& report, const char* section, const char* name) {
  const json value = report.value(section, json::object()).value(name, json(0));
  if (value.is_string()) return scene::real_number_in(value.get<std::string>()).value_or(0);
  return value.is_number() ? value.get<double>() : 0;
}

// Returns the picture that shows how a run ended, as a path within the sweep's folder.
std::string picture_of(const fs::path& folder, const std::string& name) {
  fs::path last;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "frames", ignored))
    if (entry.path().extension() == ".png") last = std::max(last, entry.path());
  if (!last.empty()) return "runs/" + name + "/frames/" + last.filename().string();
  return fs::exists(folder / "contact_sheet.png", ignored) ? "runs/" + name + "/contact_sheet.png" : "";
}

page::SweepRun shown_run(const PlannedRun& run, const fs::path& folder, const std::optional<json>& report) {
  page::SweepRun shown_one{.name = run.name};
  for (const AxisValue& value : run.values) {
    shown_one.values.push_back(shown(value));
    shown_one.numbers.push_back(value.number);
  }
  if (!report) return shown_one;
  shown_one.complete = true;
  shown_one.picture = picture_of(folder, run.name);
  shown_one.digest = word_of(report->value("digest", json()));
  shown_one.steps = report->value("steps", json()).is_number() ? report->at("steps").get<double>() : 0;
  const double solid = number_at(*report, "mass", "solid"), liquid = number_at(*report, "mass", "liquid");
  shown_one.solid = solid / 4096;
  shown_one.liquid = liquid / 4096;
  shown_one.seconds = number_at(*report, "seconds", "total");
  if (const std::optional<page::StepsTable> steps = page::read_steps(folder / "steps.csv"))
    shown_one.curve = page::liquid_share(*steps);
  return shown_one;
}

}  // namespace

std::string last_line_of(const fs::path& log) {
  std::ifstream stream(log);
  std::string line, last;
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  return one_line(last);
}

std::size_t gather(const Plan& plan, const std::vector<PlannedRun>& runs, const SweepFolder& folder,
                   const Failures& failures) {
  Table table(plan);
  page::SweepPage shown_page{.title = plan.title, .scene = fs::path(plan.scene).stem().string()};
  for (const Axis& axis : plan.axes) shown_page.axes.push_back(axis.key);
  std::size_t complete = 0;
  for (const PlannedRun& run : runs) {
    const fs::path place = folder.run_place(run);
    const std::optional<json> report = report_of(place);
    if (report) table.add(run, *report);
    complete += report ? 1 : 0;
    shown_page.runs.push_back(shown_run(run, place, report));
    if (const auto failed = failures.find(run.name); failed != failures.end())
      shown_page.runs.back().failure = failed->second;
  }
  io::write_file(folder.place() / "table.csv", table.text());
  io::write_file(folder.place() / "index.html", page::sweep_html(shown_page));
  return complete;
}

}  // namespace voxmelt::app
