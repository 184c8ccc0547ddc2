// The reports of a front are tested: every number can be read back, and the page stands alone.
#include "report/accuracy/front.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "accuracy/front/subject.h"

namespace voxmelt::accuracy {
namespace {

using namespace front;

FrontReport report() {
  Swept one{.subject = &all_subjects().front(), .usual = {}, .usual_seconds = 2, .noise = {0.001, 0.02}};
  const auto add = [&](Axis axis, const Setting& setting, double curves, double map, double seconds) {
    one.points.push_back({.axis = axis,
                          .setting = setting,
                          .reference = curves == 0,
                          .difference = {{curves, 0, curves / 2, 0}, map},
                          .seconds = seconds});
  };
  add(Axis::step, {}, 0.008, 0.03, 2);
  add(Axis::step, {.step = 0.5}, 0, 0, 4);
  add(Axis::visibility, {.interval = 4}, 0.009, 0.001, 1.5);
  add(Axis::visibility, {}, 0, 0, 2);
  add(Axis::grid, {.grid = 0.75}, 0.04, 0.01, 0.5);
  add(Axis::grid, {}, 0, 0, 2);
  add(Axis::neighbours, {.neighbours = 26}, 0.05, 0.01, 3);
  add(Axis::neighbours, {}, 0, 0, 2);
  one.formats = {{{Number::u8, Rounding::dithered}, 0.5, 26}, {kEngine, 0.002, 50}};
  one.picks = {{.bound = 0.01,
                .setting = {.interval = 4},
                .without = {Axis::step, Axis::rays},
                .sum = 0.017,
                .curves_alone = true,
                .seconds = 1.5},
               {.bound = 0.001, .without = {Axis::step}, .none = true, .sum = 0.008, .seconds = 2}};
  return {"v <1>", "avx2", Extent::full, {one}, 12};
}

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(FrontReport, JsonHasPointsNoiseAndPicks) {
  const nlohmann::json json = nlohmann::json::parse(json_text(report()));
  ASSERT_EQ(json["points"].size(), 8u);
  const auto& point = json["points"][2];
  EXPECT_EQ(point["scene"], "cello");
  EXPECT_EQ(point["axis"], "visibility");
  EXPECT_EQ(point["visibility_every"], 4);
  EXPECT_EQ(point["error"], 0.009);
  EXPECT_EQ(point["liquid_error"], 0.009);
  EXPECT_EQ(point["heat_error"], 0);
  EXPECT_EQ(point["map_error"], 0.001);
  EXPECT_EQ(point["run_seconds"], 1.5);
  EXPECT_EQ(point["usual"], false);
  EXPECT_EQ(json["points"][0]["error"], 0.03);  // the map's
  EXPECT_EQ(json["points"][0]["usual"], true);
  EXPECT_EQ(json["points"][1]["reference"], true);
  const auto& scene = json["scenes"][0];
  EXPECT_EQ(scene["noise_of_curves"], 0.001);
  EXPECT_EQ(scene["noise_of_map"], 0.02);
  EXPECT_EQ(scene["usual_seconds"], 2);
  EXPECT_EQ(scene["picks"][0]["setting"]["visibility_every"], 4);
  EXPECT_EQ(scene["picks"][0]["without"], (nlohmann::json{"step", "rays"}));
  EXPECT_EQ(scene["picks"][0]["curves_alone"], true);
  EXPECT_EQ(scene["picks"][1]["none"], true);
  EXPECT_TRUE(scene["picks"][1]["setting"].is_null());
  EXPECT_EQ(scene["formats"][1]["state_bits"], 50);
}

TEST(FrontReport, CsvHasALineForEachPoint) {
  std::istringstream lines(csv_text(report()));
  std::string line, header;
  std::getline(lines, header);
  EXPECT_EQ(header.substr(0, 15), "scene,axis,name");
  int rows = 0;
  for (; std::getline(lines, line); ++rows) EXPECT_EQ(count(header, ","), count(line, ",")) << line;
  EXPECT_EQ(rows, 8);
}

TEST(FrontReport, PageStandsAloneAndSaysWhichSetting) {
  const std::string page = html_text(report());
  EXPECT_EQ(count(page, "http"), 0);
  EXPECT_EQ(count(page, "<script"), 0);
  EXPECT_EQ(count(page, "<img"), 0);
  EXPECT_EQ(count(page, "prefers-color-scheme: dark"), 1);
  EXPECT_EQ(count(page, "v &lt;1&gt;"), 1);
  EXPECT_EQ(count(page, "<svg"), 1);
  // The page has a title, and so has each dot: neither references nor another stencil are dots.
  EXPECT_EQ(count(page, "<title>"), 1 + 3);
  EXPECT_EQ(count(page, "class=\"label\""), 2);  // both axes have their names
  EXPECT_EQ(count(page, "<td>visibility_every = 4</td><td>step, rays</td><td class=\"n\">1.7 % *</td>"), 1);
  EXPECT_EQ(count(page, "A star:"), 1);
}

TEST(FrontReport, MarkdownHasThePicksAndThePoints) {
  const std::string text = markdown_text(report());
  for (const char* row : {"| cello | 1 % | visibility_every = 4 | step, rays | 1.7 % * | 1.50 s | 2.00 s |\n",
                          "| cello | 0.1 % | none | step | 0.8 % | - | 2.00 s |\n",
                          "| cello |  | grid 0.75 |  | 4 % | 0.50 s | 2.00 s |\n",
                          "| step | step x 1 (usual) | 0.8 % | 3 % | 2.00 s |\n",
                          "| step | step 1/2 | reference |  | 4.00 s |\n", "| u8 dithered | 26 | 50 % |\n"})
    EXPECT_EQ(count(text, row), 1) << row;
  EXPECT_EQ(count(text, "curves by up to 0.1 %, and the map by up to 2 %"), 1);
  EXPECT_EQ(count(text, "scene's own size"), 1);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '|') {
      EXPECT_LE(line.size(), 100u) << line;
    }
}

TEST(FrontReport, TheQuickSetSaysThatItsGridIsSmall) {
  FrontReport quick = report();
  quick.extent = Extent::quick;
  EXPECT_EQ(count(markdown_text(quick), "on a small grid"), 1);
  EXPECT_EQ(count(html_text(quick), "on a small grid"), 1);
}

TEST(FrontReport, Percents) {
  EXPECT_EQ(percent_text(0), "0 %");
  EXPECT_EQ(percent_text(0.143), "14.3 %");
  EXPECT_EQ(percent_text(0.00191), "0.19 %");
}

}  // namespace
}  // namespace voxmelt::accuracy
