// The reports of a front are tested: every number can be read back, and the page stands alone.
#include "report/accuracy/front.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>

#include "accuracy/front/subject.h"

namespace voxmelt::accuracy {
namespace {

using namespace front;

FrontReport report() {
  Swept one{&all_subjects().front(),
            {.step = 0.25, .neighbours = 26, .rays = 16, .interval = 1},
            {.grid = 1},
            0.002,
            {}};
  const auto add = [&](Axis axis, const Setting& setting, std::optional<double> seconds, double whole) {
    Measured point{.choice = {axis, setting}, .twin = !seconds};
    point.cost = {50, seconds, 1.5e8, seconds ? std::optional(3e7) : std::nullopt, seconds ? 0 : 0.5};
    if (axis == Axis::grid) {
      point.grid = Errors{whole, 0, 0, 0};
    } else {
      point.whole = Errors{whole, 0, 0, 0};
      point.arithmetic = Errors{0, whole / 10, 0, 0};
      point.model = Errors{0, 0, whole * 2, 0};
    }
    one.points.push_back(point);
  };
  add(Axis::usual, {}, 1, 0.05);
  add(Axis::step, {.step = 0.5}, 2, 0.008);
  add(Axis::rays, {.rays = 16}, 3, 0.04);
  add(Axis::grid, {.grid = 0.25}, 0.1, 0.03);
  add(Axis::format, {.arithmetic = kExact}, std::nullopt, 0.04);
  return {"v <1>", "avx2", Extent::full, {one}, 12};
}

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(FrontReport, JsonKeepsErrorsApart) {
  const nlohmann::json json = nlohmann::json::parse(json_text(report()));
  ASSERT_EQ(json["points"].size(), 5u);
  EXPECT_EQ(json["axes"], 4);
  const auto& step = json["points"][1];
  EXPECT_EQ(step["scene"], "cello");
  EXPECT_EQ(step["axis"], "step");
  EXPECT_EQ(step["step"], 0.5);
  EXPECT_EQ(step["whole_error"]["largest"], 0.008);
  EXPECT_EQ(step["model_error"]["height"], 0.016);
  EXPECT_DOUBLE_EQ(step["arithmetic_error"]["heat"].get<double>(), 0.0008);
  EXPECT_EQ(step["arithmetic_error"]["liquid"], 0);
  EXPECT_EQ(step["run_seconds"], 2);
  EXPECT_EQ(step["baseline_cells_per_second"], 3e7);
  EXPECT_EQ(step["format"], "u16");
  EXPECT_EQ(step["rounding"], "dithered");
  EXPECT_EQ(step["computed_by"], "engine");
  EXPECT_EQ(step["on_the_front"], true);
  EXPECT_EQ(json["points"][2]["on_the_front"], false);  // 3 s for 4 %
  EXPECT_EQ(json["points"][3]["on_the_front"], false);  // another grid
  EXPECT_TRUE(json["points"][3]["whole_error"].is_null());
  EXPECT_EQ(json["points"][4]["computed_by"], "twin");
  EXPECT_EQ(json["points"][4]["format"], "double");
  EXPECT_EQ(json["points"][4]["rounding"], "");
  EXPECT_TRUE(json["points"][4]["run_seconds"].is_null());
  EXPECT_EQ(json["scenes"][0]["error_between_seeds"], 0.002);
}

TEST(FrontReport, CsvHasALineForEachPoint) {
  std::istringstream lines(csv_text(report()));
  std::string line, header;
  std::getline(lines, header);
  EXPECT_EQ(header.substr(0, 15), "scene,axis,name");
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    EXPECT_EQ(count(header, ","), count(line, ",")) << line;
    if (rows == 1) {
      EXPECT_NE(line.find(",0.008,"), std::string::npos) << line;
    }
  }
  EXPECT_EQ(rows, 5);
}

TEST(FrontReport, PageStandsAloneAndSaysWhichSetting) {
  const std::string page = html_text(report());
  EXPECT_EQ(count(page, "http"), 0);
  EXPECT_EQ(count(page, "<script"), 0);
  EXPECT_EQ(count(page, "<img"), 0);
  EXPECT_EQ(count(page, "prefers-color-scheme: dark"), 1);
  EXPECT_EQ(count(page, "v &lt;1&gt;"), 1);
  EXPECT_EQ(count(page, "<svg"), 3);
  EXPECT_EQ(count(page, "<title>"), 1 + 3 + 1 + 1);  // the page's, and a dot for each point of a picture
  EXPECT_EQ(count(page, "class=\"ring\""), 1);
  EXPECT_EQ(count(page, "class=\"label\""), 2 * 3);  // every axis has its name
  EXPECT_EQ(
      count(page,
            "<dt>1 %</dt><dd>step 1/2: error 0.8 % (model 1.6 %, arithmetic 0.08 %), 2.00 s a run</dd>"),
      1);
  EXPECT_EQ(count(page, "<dt>0.1 %</dt><dd>none of the settings measured</dd>"), 1);
  EXPECT_EQ(count(page, "No setting is both faster and better"), 1);
}

TEST(FrontReport, MarkdownHasTheWordsAndThePoints) {
  const std::string text = markdown_text(report());
  EXPECT_NE(text.find("| cello | 1 % | step 1/2: error 0.8 %"), std::string::npos);
  EXPECT_NE(text.find("| grid 0.25 | grid | - | - | - | 3 % | 50 | 0.10 s | 150 | 30.0 |"),
            std::string::npos);
  EXPECT_NE(text.find("| double | format |"), std::string::npos);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '|') {
      EXPECT_LE(line.size(), 100u) << line;
    }
}

TEST(FrontReport, Percents) {
  EXPECT_EQ(percent_text(0), "0 %");
  EXPECT_EQ(percent_text(0.143), "14.3 %");
  EXPECT_EQ(percent_text(0.00191), "0.19 %");
}

}  // namespace
}  // namespace voxmelt::accuracy
