// The reports are tested: gates decide, numbers are those of the rows, and each text can be read back.
#include "report/accuracy/report.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/svg/axis.h"

namespace voxmelt::accuracy {
namespace {

Row row(double value, double exact, Measure measure, std::optional<double> gate) {
  return {.setting = "a <setting>, \"quoted\"",
          .quantity = "cells | steps",
          .value = value,
          .exact = exact,
          .measure = measure,
          .gate = gate,
          .note = "odd",
          .speed = {.cells_per_second = 1.5e6, .state_bits = 18}};
}

const Case kCase{"a_case", "Family", "A title", "About it.", nullptr};

Report report(std::vector<Row> rows) {
  Chart chart{.title = "Chart & all", .x_label = "x", .y_label = "y", .band = 1};
  chart.curves = {{.name = "exact", .points = {{0, 0}, {1, 1}}, .exact = true},
                  {.name = "found", .points = {{0, 0.1}, {0.5, 0.6}, {1, 1.2}}}};
  Report all{.version = "v", .implementation = "reference", .sets = {}, .found = {}};
  all.found.push_back({&kCase, {std::move(rows), {chart}}, 2});
  return all;
}

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(Row, ErrorsAndGates) {
  EXPECT_NEAR(row(101, 100, Measure::relative, 0.02).error(), 0.01, 1e-12);
  EXPECT_NEAR(row(101, 100, Measure::absolute, 0.02).error(), 1, 1e-12);
  EXPECT_TRUE(row(98, 100, Measure::relative, 0.0201).passed());
  EXPECT_FALSE(row(97.9, 100, Measure::relative, 0.02).passed());
  EXPECT_TRUE(row(500, 100, Measure::relative, std::nullopt).passed());
  EXPECT_TRUE(row(0, 0, Measure::absolute, 0).passed());
  EXPECT_FALSE(row(1, 0, Measure::absolute, 0).passed());
  EXPECT_FALSE(row(std::numeric_limits<double>::quiet_NaN(), 1, Measure::relative, 0.1).passed());
}

TEST(Report, OneMissedGateFailsIt) {
  const Row good = row(1.001, 1, Measure::relative, 0.01), bad = row(1.1, 1, Measure::relative, 0.01),
            told = row(3, 1, Measure::relative, std::nullopt);
  EXPECT_TRUE(report({good, told}).passed());
  EXPECT_FALSE(report({good, bad, told}).passed());
  EXPECT_EQ(report({good, bad, told}).gates(), 2);
  EXPECT_EQ(report({good, bad, told}).missed(), 1);
}

TEST(Report, JsonHasEveryNumber) {
  const nlohmann::json json = nlohmann::json::parse(json_text(
      report({row(1.1, 1, Measure::relative, 0.01), row(0.5, 0, Measure::absolute, std::nullopt)})));
  EXPECT_EQ(json["passed"], false);
  EXPECT_EQ(json["cases"].size(), 2u);
  EXPECT_EQ(json["cases"][0]["name"], "a_case");
  EXPECT_NEAR(json["cases"][0]["error"].get<double>(), 0.1, 1e-12);
  EXPECT_EQ(json["cases"][0]["gate"], 0.01);
  EXPECT_EQ(json["cases"][0]["passed"], false);
  EXPECT_EQ(json["cases"][0]["cells_per_second"], 1.5e6);
  EXPECT_TRUE(json["cases"][0]["baseline_cells_per_second"].is_null());
  EXPECT_TRUE(json["cases"][1]["gate"].is_null());
  EXPECT_EQ(json["charts"][0]["curves"][1]["points"].size(), 3u);
}

TEST(Report, PageIsSelfContainedAndDrawsEveryPoint) {
  const std::string page = html_text(report({row(1.1, 1, Measure::relative, 0.01)}));
  EXPECT_EQ(count(page, "http"), 0);
  EXPECT_EQ(count(page, "<script"), 0);
  EXPECT_EQ(count(page, "<title>found: "), 3);  // a dot for each point
  EXPECT_EQ(count(page, "<path class=\"exact\""), 1);
  EXPECT_EQ(count(page, "class=\"band\""), 1);
  EXPECT_EQ(count(page, "a &lt;setting&gt;, &quot;quoted&quot;"), 2);  // in the table and over the gate's dot
  EXPECT_EQ(count(page, "+10.0 %"), 2);
  EXPECT_EQ(count(page, "prefers-color-scheme: dark"), 1);
}

// In the picture of all gates, 0 over a gate of 0 is at the left end, with the rows that pass. 1 over 0 is at
// the right end.
TEST(Report, ExactErrorsAreWithinExactGates) {
  const std::string page =
      html_text(report({row(0, 0, Measure::absolute, 0), row(1, 0, Measure::absolute, 0)}));
  EXPECT_EQ(count(page, "<circle class=\"good\" cx=\"160.0\""), 1);
  EXPECT_EQ(count(page, "<circle class=\"bad\" cx=\"1030.0\""), 1);
}

// Rows without a gate are drawn as well. By hand: 1.7 and 53 are 70 % and 6 % off, 7 and 0.6 times a tenth.
// Over an exact 0 the bar is 0.1.
TEST(Report, ErrorsWithoutAGateAreDrawn) {
  EXPECT_NEAR(row(1.7, 1, Measure::relative, {}).bar(), 0.1, 1e-12);
  EXPECT_NEAR(row(53, 50, Measure::absolute, {}).bar(), 5, 1e-12);
  EXPECT_NEAR(row(53, -50, Measure::absolute, {}).bar(), 5, 1e-12);
  EXPECT_NEAR(row(0.2, 0, Measure::absolute, {}).bar(), 0.1, 1e-12);
  EXPECT_NEAR(row(53, 50, Measure::absolute, 2).bar(), 2, 1e-12);
  const std::string page = html_text(report({row(11, 1, Measure::relative, {})}));  // a hundred times the bar
  EXPECT_EQ(count(page, "<circle class=\"told\" cx=\"885.0\""), 1);
  EXPECT_EQ(count(page, "reported</title>"), 1);
}

TEST(Report, TablesHaveOneWidth) {
  const std::string text = markdown_text(report({row(1.1, 1, Measure::relative, 0.01)}));
  EXPECT_NE(text.find("**0 of 1 gates passed.**"), std::string::npos);
  EXPECT_NE(text.find("| cells / steps | 1.100 | 1.000 | +10.0 % | 1 % | **missed** | 1.50 | - |"),
            std::string::npos);
  EXPECT_NE(text.find("|\n\n- a <setting>, \"quoted\": odd\n"), std::string::npos);
  EXPECT_NE(csv_text(report({row(2, 1, Measure::relative, 0.5)})).find("\"a <setting>, \"\"quoted\"\"\""),
            std::string::npos);
}

TEST(Axis, TicksAreRoundAndCoverTheRange) {
  const page::Axis linear(0.3, 9.7, false, 0, 100);
  EXPECT_EQ(linear.ticks(), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_NEAR(linear(5), 50, 1e-9);
  const page::Axis logarithmic(1, 1000, true, 100, 0);
  EXPECT_EQ(logarithmic.ticks(), (std::vector<double>{1, 10, 100, 1000}));
  EXPECT_NEAR(logarithmic(10), 100.0 * 2 / 3, 1e-9);
}

}  // namespace
}  // namespace voxmelt::accuracy
