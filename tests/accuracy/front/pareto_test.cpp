// Fronts of a few places are found by hand, with the settings that they name.
#include "accuracy/front/pareto.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "accuracy/front/words.h"

namespace voxmelt::accuracy::front {
namespace {

using Indices = std::vector<std::size_t>;

TEST(Pareto, DominatedPlacesGo) {
  const std::vector<Place> places{{3, 1}, {1, 5}, {2, 5}, {2, 3}, {4, 1}, {5, 0.5}, {3, 2}};
  EXPECT_EQ(undominated(places), (Indices{1, 3, 0, 5}));  // (2, 5) is as wrong as (1, 5) and dearer
}

TEST(Pareto, OfEqualPlacesTheFirstStays) {
  const std::vector<Place> places{{2, 2}, {1, 3}, {2, 2}};
  EXPECT_EQ(undominated(places), (Indices{1, 0}));
  EXPECT_EQ(undominated({}), Indices{});
}

// The front is held against the definition itself, on places of a small lattice, so that ties are many.
TEST(Pareto, IsTheDefinition) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::vector<Place> places;
    for (unsigned i = 0, n = seed; i < 12; ++i) {
      n = n * 1103515245u + 12345u;
      places.push_back({1. * (n >> 16 & 7u), 1. * (n >> 20 & 7u)});
    }
    const Indices found = undominated(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      bool beaten = false;
      for (std::size_t j = 0; j < places.size(); ++j) {
        if (j == i) continue;
        const Place &a = places[j], &b = places[i];
        const bool equal = a.cost == b.cost && a.error == b.error;
        if (a.cost <= b.cost && a.error <= b.error && (!equal || j < i)) beaten = true;
      }
      bool kept = false;
      for (const std::size_t k : found) kept = kept || k == i;
      EXPECT_EQ(kept, !beaten) << "seed " << seed << ", place " << i;
    }
  }
}

TEST(Pareto, PicksTheCheapestWithinABound) {
  const std::vector<Place> places{{9, 0.0001}, {2, 0.02}, {4, 0.009}, {5, 0.01}, {7, 0.0001}};
  EXPECT_EQ(cheapest_within(places, 0.01), std::optional<std::size_t>(2));
  EXPECT_EQ(cheapest_within(places, 0.02), std::optional<std::size_t>(1));
  EXPECT_EQ(cheapest_within(places, 0.001), std::optional<std::size_t>(4));
  EXPECT_EQ(cheapest_within(places, 0.00001), std::nullopt);
  EXPECT_EQ(best(places), std::optional<std::size_t>(4));
  EXPECT_EQ(best({}), std::nullopt);
}

Errors all(double error) { return {error, error / 2, 0, error}; }

// The sweep has the usual setting, a finer one, one that is dearer and worse, another grid and three formats.
Swept swept() {
  Swept one{&all_subjects().front(), {}, {}, 0.002, {}};
  const auto add = [&](Axis axis, const Setting& setting, std::optional<double> seconds, double whole) {
    Measured point{.choice = {axis, setting}, .twin = !seconds};
    point.cost = {50, seconds, 1e8, std::nullopt, 1};
    if (axis == Axis::grid)
      point.grid = all(whole);
    else {
      point.whole = all(whole);
      point.arithmetic = all(whole / 10);
      point.model = all(whole);
    }
    one.points.push_back(point);
  };
  add(Axis::usual, {}, 1, 0.05);
  add(Axis::step, {.step = 0.5}, 2, 0.008);
  add(Axis::rays, {.rays = 16}, 3, 0.04);
  add(Axis::grid, {.grid = 0.25}, 0.1, 0.0001);  // right, but it answers another question
  add(Axis::format, {.arithmetic = {Number::u8, Rounding::dithered}}, std::nullopt, 0.5);
  add(Axis::rounding, {.arithmetic = kEngine}, std::nullopt, 0.05);
  add(Axis::format, {.arithmetic = kExact}, std::nullopt, 0.05);
  one.points[4].cost.state_bits = 26;
  one.points[6].cost.state_bits = 194;
  one.points[6].arithmetic = Errors{};
  return one;
}

TEST(Words, FrontsHoldWhatBelongsTogether) {
  const Swept one = swept();
  EXPECT_EQ(run_time_against_whole_error(one).point, (Indices{0, 1, 2}));
  EXPECT_EQ(run_time_against_grid_error(one).point, (Indices{3}));
  EXPECT_EQ(bits_against_arithmetic_error(one).point, (Indices{4, 5, 6}));
  EXPECT_EQ(run_time_against_whole_error(one).places[1].cost, 2);
  EXPECT_EQ(run_time_against_whole_error(one).places[1].error, 0.008);
  EXPECT_EQ(bits_against_arithmetic_error(one).places[0].cost, 26);
  EXPECT_EQ(bits_against_arithmetic_error(one).places[0].error, 0.05);
}

// A run of the engine that is the reference has no error, because it is compared with itself.
TEST(Words, ARunThatIsItsOwnReferenceIsOnNoFront) {
  Swept one = swept();
  one.subject = &all_subjects().back();
  ASSERT_TRUE(one.subject->viscous);
  one.reference = one.points[1].choice.setting;
  EXPECT_EQ(run_time_against_whole_error(one).point, (Indices{0, 2}));
  one.subject = &all_subjects().front();  // by the paper's law the reference is the twin's
  EXPECT_EQ(run_time_against_whole_error(one).point, (Indices{0, 1, 2}));
}

TEST(Words, PicksName) {
  const Swept one = swept();
  const std::vector<Pick> settings = picks_of_settings(one), formats = picks_of_formats(one);
  ASSERT_EQ(settings.size(), 3u);
  EXPECT_EQ(settings[0].bound, "1 %");
  EXPECT_EQ(settings[0].point, &one.points[1]);
  EXPECT_EQ(settings[1].bound, "0.1 %");
  EXPECT_EQ(settings[1].point, nullptr);
  EXPECT_EQ(settings[2].bound, "best");
  EXPECT_EQ(settings[2].point, &one.points[1]);
  EXPECT_EQ(formats[0].point, &one.points[5]);  // 0.5 %
  EXPECT_EQ(formats[1].point, &one.points[6]);
}

TEST(Words, WhatBeatsTheUsualSettingIsNamed) {
  Swept one = swept();
  EXPECT_TRUE(faster_and_better(one).empty());  // the right grid point answers another question
  one.points[1].cost.run_seconds = 0.9;
  one.points[2].cost.run_seconds = 0.8;
  EXPECT_EQ(faster_and_better(one), (std::vector<const Measured*>{&one.points[2], &one.points[1]}));
  one.points[2].whole = one.points[0].whole;  // as wrong as the usual one
  EXPECT_EQ(faster_and_better(one), (std::vector<const Measured*>{&one.points[1]}));
}

}  // namespace
}  // namespace voxmelt::accuracy::front
