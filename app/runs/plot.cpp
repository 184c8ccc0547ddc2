// The command `voxmelt plot` draws columns of steps.csv of one run, or of many, as one picture.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "kernel/run/io/csv.h"
#include "kernel/run/io/file_writer.h"
#include "report/runs/plot.h"
#include "report/runs/steps_table.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::vector<std::string> runs, columns;
  std::string out = "plot.svg";
  bool quiet = false;
};

struct Shown {
  std::string name;
  page::StepsTable table;
};

// Reads the table of a run, given by its folder or as a file.
Shown read_run(const std::string& given) {
  fs::path file = given;
  std::error_code ignored;
  const bool is_folder = fs::is_directory(file, ignored);
  if (is_folder) file /= io::kCsvFile;
  std::optional<page::StepsTable> table = page::read_steps(file);
  if (!table)
    throw UsageError(fmt::format("{}: error: {}; `voxmelt run --write csv` writes one", file.string(),
                                 fs::exists(file, ignored) ? "is no table of steps" : "is not there"));
  if (table->rows.empty()) throw UsageError(fmt::format("{}: error: has no rows", file.string()));
  const fs::path folder = fs::weakly_canonical(is_folder ? fs::path(given) : file.parent_path(), ignored);
  const fs::path named = folder.has_filename() ? folder : folder.parent_path();
  return {is_folder ? named.filename().string() : given, std::move(*table)};
}

// A name that two runs have is none: they are named as they were given.
std::vector<Shown> read_runs(const std::vector<std::string>& given) {
  std::vector<Shown> runs;
  runs.reserve(given.size());
  for (const std::string& one : given) runs.push_back(read_run(one));
  const std::vector<Shown> all = runs;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (std::ranges::count(all, all[i].name, &Shown::name) > 1) runs[i].name = given[i];
  return runs;
}

bool varies(const std::vector<Shown>& runs, const std::string& column) {
  std::optional<double> first;
  for (const Shown& run : runs)
    if (const std::optional<std::size_t> at = run.table.find(column))
      for (const page::Point& p : run.table.over_steps(*at))
        if (p.y != *(first = first.value_or(p.y))) return true;
  return false;
}

// Returns the columns that are drawn without --columns: of the usual ones those that change.
std::vector<std::string> usual_columns(const std::vector<Shown>& runs) {
  std::vector<std::string> columns;
  for (const char* column : {"solid_cells", "liquid_cells", "mass", "energy", "heat"})
    if (varies(runs, column)) columns.emplace_back(column);
  return columns.empty() ? std::vector<std::string>{"liquid_cells"} : columns;
}

page::Chart chart_of(const std::vector<Shown>& runs, const std::string& column) {
  // Colours come again after seven curves, and then with other dashes.
  constexpr std::array kDashes{"", "7 3", "2 3", "9 3 2 3"};
  page::Chart chart{.title = column, .x_label = "step"};
  for (const Shown& run : runs) {
    const std::optional<std::size_t> at = run.table.find(column);
    if (!at)
      throw UsageError(fmt::format("--columns {}: error: {} has no such column; there are {}", column,
                                   run.name, fmt::join(run.table.columns, ", ")));
    chart.curves.push_back({.name = run.name,
                            .points = run.table.over_steps(*at),
                            .mark = run.table.rows.size() > 1 ? page::Mark::line : page::Mark::dots,
                            .dashes = kDashes[chart.curves.size() / page::kColours % kDashes.size()]});
  }
  return chart;
}

int draw_plot(const PlotOptions& options) {
  check_place("--out", options.out, "");
  const std::vector<Shown> runs = read_runs(options.runs);
  std::vector<page::Chart> charts;
  for (const std::string& column : options.columns.empty() ? usual_columns(runs) : options.columns)
    charts.push_back(chart_of(runs, column));
  io::write_file(options.out, page::plot_svg(charts));
  if (!options.quiet) print("plot  {}\n", options.out);
  return kDone;
}

}  // namespace

void add_plot(CommandLine& program) {
  auto options = std::make_shared<PlotOptions>();
  const Command command = program.add("plot", "Draw the curves of one run, or of many, as one SVG");
  command.option("run", options->runs, "folders of runs with steps.csv (`run --write csv`), or such files")
      .required();
  command
      .option("--columns", options->columns,
              "columns of steps.csv, separated by commas (default: cells and sums that change)")
      .separated_by(',')
      .one_each_time();
  command.option("--out", options->out, "file to write").shows_default();
  command.flag("--quiet", options->quiet, "do not name the file");
  command.runs([options] { return draw_plot(*options); });
}

}  // namespace voxmelt::app
