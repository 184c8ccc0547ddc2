// Parts of a picture are drawn alone, a run that hangs names its cause, and faults are planted in every
// channel.
#include "hwmodel/caster/check/replay_pixel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/caster/check/memory_check.h"
#include "hwmodel/caster/check/tile_check.h"
#include "hwmodel/caster/check/verify_picture.h"
#include "tests/kernel/worlds.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// Makes a block of solid under liquid, before the background: its rim is drawn twice.
test::HostilePicture block(int pixels) {
  test::HostilePicture picture;
  picture.volume = state::Volume(state::Grid{20, 16, 20});
  worlds::for_each({4, 2, 4, 16, 12, 16}, [&](int x, int y, int z) {
    picture.volume.solid.set(x, y, z, true);
    picture.volume.amount[picture.volume.at(x, y, z)] =
        static_cast<std::uint16_t>(4096 - 500 * ((x + y + z) % 3));
  });
  picture.camera.azimuth = 30;
  picture.camera.elevation = 25;
  picture.camera.target = {10, 7, 10};
  picture.camera.width = picture.camera.height = pixels;
  picture.setting = render::Setting::normal;
  return picture;
}

PictureInput input_of(const test::HostilePicture& p) {
  return {p.volume, p.look, p.light, p.terrain, p.camera, p.setting};
}

std::string text_of(const PictureReport& report) {
  return (report.difference ? text_of(*report.difference) : "") + report.hang +
         std::to_string(report.different_bytes) + " pixels differ";
}

TEST(Window, APixelAloneIsThatOfThePicture) {
  const test::HostilePicture picture = block(29);
  const PictureReport whole = verify_picture(input_of(picture), {});
  ASSERT_TRUE(whole.good()) << text_of(whole);
  worlds::Random random(5);
  int twice = 0;
  for (int i = 0; i < 60; ++i) {
    const int x = i == 0 ? 0 : i == 1 ? 28 : random.between(0, 28), y = i < 2 ? x : random.between(0, 28);
    PictureOptions options;
    options.configuration.pipes = random.any({1, 2});
    options.window = {x, y, x + 1, y + 1};
    const PictureReport part = verify_picture(input_of(picture), options);
    ASSERT_TRUE(part.good()) << x << ' ' << y << ": " << text_of(part);
    EXPECT_EQ(part.image.at(x, y), whole.image.at(x, y)) << x << ' ' << y;
    // The pixels around it are drawn, too, as they tell whether it is drawn again, with 8 samples more.
    const std::int64_t around =
        (std::min(x + 1, 28) - std::max(x - 1, 0) + 1) * (std::min(y + 1, 28) - std::max(y - 1, 0) + 1);
    EXPECT_TRUE(part.rays == around || part.rays == around + 8) << part.rays;
    twice += part.rays == around + 8 ? 1 : 0;
    const auto tiles = [](int at) { return (std::min(at + 1, 28) / 8) - (std::max(at - 1, 0) / 8) + 1; };
    EXPECT_EQ(part.memory.written_bytes, (tiles(x) * tiles(y) + 1) * kTileBytes) << x << ' ' << y;
  }
  EXPECT_GT(twice, 2);
  EXPECT_LT(twice, 58);
}

TEST(Window, APartOfSeveralTilesIsThatOfThePicture) {
  test::HostilePicture picture = block(40);
  picture.setting = render::Setting::fast;
  const PictureReport whole = verify_picture(input_of(picture), {});
  PictureOptions options;
  options.window = {5, 11, 27, 19};
  const PictureReport part = verify_picture(input_of(picture), options);
  ASSERT_TRUE(part.good()) << text_of(part);
  EXPECT_EQ(part.rays, 22 * 8);
  EXPECT_EQ(part.memory.written_bytes, 4 * 2 * kTileBytes);  // tiles 0 .. 3 along x, 1 and 2 along y
  for (int y = 11; y < 19; ++y)
    for (int x = 5; x < 27; ++x) EXPECT_EQ(part.image.at(x, y), whole.image.at(x, y));
}

// The fault reads the table of tones one entry too far: a pixel that is drawn alone is wrong, too.
TEST(Replay, AFaultOfEveryPixelFailsAlone) {
  const test::HostilePicture picture = block(24);
  PictureOptions options;
  options.fault = Fault::press_tone;
  const PictureReport report = verify_picture(input_of(picture), options);
  ASSERT_TRUE(report.difference);
  const std::optional<PixelReplay> replay = replay_pixel(input_of(picture), options, report);
  ASSERT_TRUE(replay);
  EXPECT_TRUE(replay->fails);
  EXPECT_EQ(replay->part, (Window{report.difference->x, report.difference->y, report.difference->x + 1,
                                  report.difference->y + 1}));
  const std::string text = text_of(*replay);
  EXPECT_NE(text.find("drawn alone, fails too"), std::string::npos) << text;
  EXPECT_NE(text.find("behind stage press"), std::string::npos) << text;
}

// If a fault shows only beside other pixels, a pixel that is drawn alone is right. For a fault of tiles, a
// whole tile is drawn.
TEST(Replay, AFaultBetweenPixelsIsRightAlone) {
  const test::HostilePicture picture = block(24);
  for (const Fault fault : {Fault::channel_lost, Fault::channel_twice, Fault::dealer_twice}) {
    PictureOptions options;
    options.fault = fault;
    test::HostilePicture fast = block(24);
    fast.setting = render::Setting::fast;
    const PictureReport report = verify_picture(input_of(fast), options);
    ASSERT_TRUE(report.difference) << static_cast<int>(fault);
    const std::optional<PixelReplay> replay = replay_pixel(input_of(fast), options, report);
    ASSERT_TRUE(replay);
    EXPECT_FALSE(replay->fails) << replay->text;
    EXPECT_EQ(replay->part.right - replay->part.left, fault == Fault::dealer_twice ? 8 : 1);
    EXPECT_NE(text_of(*replay).find("drawn alone, is right"), std::string::npos);
  }
}

TEST(Replay, WhatOnlyTheBytesShowIsReplayedWithItsStage) {
  const test::HostilePicture picture = block(24);
  PictureOptions options;
  options.fault = Fault::pixel_channels;
  options.compare = false;
  const PictureReport report = verify_picture(input_of(picture), options);
  ASSERT_FALSE(report.difference);
  ASSERT_FALSE(report.good());
  ASSERT_TRUE(report.different);
  const std::optional<PixelReplay> replay = replay_pixel(input_of(picture), options, report);
  ASSERT_TRUE(replay);
  EXPECT_TRUE(replay->fails);
  EXPECT_NE(replay->text.find("behind stage pixel"), std::string::npos) << replay->text;
  PictureReport told;
  told.end.complete = true;
  told.compared = told.different_bytes = 1;
  told.different = RayId{7, 3, 0, 0};
  const std::optional<PixelReplay> there = replay_pixel(input_of(picture), {}, told);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->part, (Window{7, 3, 8, 4}));
  EXPECT_FALSE(there->fails);
}

TEST(Replay, AGoodPictureHasNone) {
  const test::HostilePicture picture = block(16);
  const PictureReport report = verify_picture(input_of(picture), {});
  ASSERT_TRUE(report.good()) << text_of(report);
  EXPECT_FALSE(replay_pixel(input_of(picture), {}, report));
}

TEST(Hang, NamesTheChannelThatTakesNothingAndARayUnderWay) {
  for (const char* channel :
       {"set-up -> ground", "walk -> crossing", "light -> arriving", "pixel -> write"}) {
    PictureOptions options;
    options.fault = Fault::channel_never_ready;
    options.fault_channel = channel;
    const PictureReport report = verify_picture(input_of(block(24)), options);
    ASSERT_TRUE(report.strike) << channel;
    ASSERT_FALSE(report.good());
    EXPECT_TRUE(report.found_where_planted()) << channel << '\n' << text_of(report);
    EXPECT_NE(report.hang.find(channel), std::string::npos) << report.hang;
    EXPECT_NE(report.hang.find("nothing moves any more"), std::string::npos);
    if (std::string(channel) == "walk -> crossing" || std::string(channel) == "light -> arriving") {
      EXPECT_TRUE(report.under_way) << channel;
      EXPECT_NE(report.hang.find("a ray under way: pixel ("), std::string::npos) << report.hang;
    }
  }
}

// Nothing follows the last token through the channel. So its loss shows only when everything stands still.
TEST(Hang, NamesTheLastTokenThatIsLost) {
  for (const char* channel : {"set-up -> ground", "light -> arriving", "press -> pixel"}) {
    test::HostilePicture row = block(3);
    row.camera.height = 1;
    row.setting = render::Setting::fast;
    PictureOptions options;
    options.fault = Fault::channel_lost;
    options.fault_channel = channel;
    const PictureReport report = verify_picture(input_of(row), options);
    ASSERT_TRUE(report.strike) << channel;
    ASSERT_TRUE(report.difference) << channel << '\n' << report.hang;
    EXPECT_TRUE(report.found_where_planted()) << text_of(report);
    if (std::string(channel) == "press -> pixel") continue;  // the ray ends there
    ASSERT_TRUE(report.under_way);
    EXPECT_EQ(report.under_way->x, report.difference->x);
  }
}

TEST(TileCheck, ABurstThatIsWrittenTwiceIsFound) {
  std::vector<Difference> told;
  TileCheck check(20, 12, [&](const Difference& difference) { told.push_back(difference); });
  check.begin_pass({});
  check.written(4, 1);
  check.written(4, 2);
  ASSERT_TRUE(told.empty());
  check.written(4, 1);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].stage, "write");
  EXPECT_EQ(told[0].x, 8);  // the row has three tiles
  EXPECT_EQ(told[0].y, 8);
}

TEST(MemoryCheck, AReplyIsOfAnOpenRequestOfItsPipeAndComesOnce) {
  std::vector<Difference> told;
  MemoryCheck check([&](const Difference& difference) { told.push_back(difference); });
  LineRequest request;
  request.client = 2;
  request.slot = 5;
  request.address = 640;
  request.bytes = 128;
  const LineReply reply{2, 5, 640, 128};
  const int ask = 191, answer = 192, other = 92;  // channels: two of pipe 1, and one of pipe 0
  check.entered(ask, 0, &request);
  check.left(answer, 0, &reply);
  EXPECT_TRUE(told.empty());
  check.left(answer, 1, &reply);
  EXPECT_EQ(told.size(), 1U);
  check.entered(ask, 1, &request);
  check.left(other, 0, &reply);
  EXPECT_EQ(told.size(), 2U);
  for (const LineReply& wrong : {LineReply{1, 5, 640, 128}, LineReply{2, 4, 640, 128},
                                 LineReply{2, 5, 704, 128}, LineReply{2, 5, 640, 64}}) {
    const std::size_t before = told.size();
    check.left(answer, 2, &wrong);
    EXPECT_EQ(told.size(), before + 1);
    EXPECT_EQ(told.back().address, wrong.address);
  }
  check.left(answer, 3, &reply);
  EXPECT_EQ(told.size(), 6U);
}

// A picture that was not compared is not good, even if its bytes are right.
TEST(Verdict, ComparingNothingFails) {
  PictureReport report;
  report.end.complete = true;
  report.compared = 1;
  EXPECT_TRUE(report.good());
  report.compared = 0;
  EXPECT_FALSE(report.good());
}

// Tokens that are lost, come twice or change places are found in their channel, at their pixel.
TEST(Channels, EachFaultIsFoundInEachChannel) {
  const std::vector<std::string> channels{
      "set-up -> ground",  "ground -> walk",     "ask -> levels",    "levels -> sample",  "levels -> normal",
      "sample -> walk",    "sample -> crossing", "walk -> crossing", "walk -> met",       "crossing -> met",
      "met -> normal",     "normal -> paint",    "paint -> texture", "texture -> matter", "matter -> light",
      "light -> arriving", "arriving -> mirror", "mirror -> colour", "colour -> press",   "press -> pixel",
      "pixel -> write"};
  int swaps = 0;
  for (const std::string& channel : channels)
    for (const Fault fault : {Fault::channel_lost, Fault::channel_twice, Fault::channel_swap}) {
      int struck = 0;
      for (const int seed : {0, 3, 8}) {
        PictureOptions options;
        options.configuration.stall_seed = static_cast<std::uint64_t>(seed);
        options.configuration.pipes = 1 + seed % 2;
        options.fault = fault;
        options.fault_channel = channel;
        const PictureReport report = verify_picture(input_of(block(24)), options);
        if (!report.strike) continue;
        ++struck;
        EXPECT_TRUE(report.found_where_planted())
            << channel << ", fault " << static_cast<int>(fault) << ", seed " << seed << ": planted at pixel "
            << report.strike->x << ' ' << report.strike->y << " sample " << report.strike->sample << '\n'
            << text_of(report);
      }
      if (fault == Fault::channel_swap)
        swaps += struck > 0 ? 1 : 0;
      else
        EXPECT_EQ(struck, 3) << channel;
    }
  EXPECT_GE(swaps, 12);  // two tokens must be in the channel at once
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
