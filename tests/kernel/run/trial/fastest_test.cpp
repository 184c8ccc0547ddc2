// `auto` takes the fastest of a trial, and remembers it for the same program on the same processor.
#include "kernel/run/trial/fastest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "kernel/run/simulation.h"

namespace voxmelt::run {
namespace {

namespace fs = std::filesystem;

class Fastest : public testing::Test {
 protected:
  Fastest()
      : folder_(fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    for (const char* name : {"plain", "narrow", "wide", "wider", "alien"})
      registry_.add({name, "", nullptr, std::string(name) != "alien"});
  }
  ~Fastest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  Choice choice(const std::string& machine = "this") {
    return choose(registry_, file(), machine, [this](const std::vector<const step::Implementation*>& all) {
      ++trials_;
      std::vector<TrialTime> times;
      times.reserve(all.size());
      for (const step::Implementation* one : all) times.push_back({one, seconds_.at(one->name)});
      return times;
    });
  }
  fs::path file() const { return folder_ / "voxmelt" / "fastest"; }
  std::vector<std::string> lines() const {
    std::ifstream in(file());
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  void write(const std::string& text) const {
    fs::create_directories(file().parent_path());
    std::ofstream(file()) << text;
  }

  fs::path folder_;
  step::Registry registry_;
  std::map<std::string, double> seconds_{
      {"narrow", 3}, {"wide", 1.5}, {"wider", 1.8}};  // "plain" is never tried
  int trials_ = 0;
};

TEST_F(Fastest, TheLeastTimeAndByHowMuch) {
  const Choice chosen = choice();
  EXPECT_EQ(chosen.implementation->name, "wide");
  EXPECT_EQ(chosen.reason,
            "2.00 times as fast as narrow, 1.20 times as fast as wider, in a trial on this processor");
}

TEST_F(Fastest, RememberedForOneMachine) {
  const Choice first = choice();
  seconds_ = {{"narrow", 1}, {"wide", 4}, {"wider", 2}};
  EXPECT_EQ(choice().implementation->name, "wide") << "no second trial";
  EXPECT_EQ(choice().reason, first.reason);
  EXPECT_EQ(trials_, 1);
  EXPECT_EQ(choice("other").implementation->name, "narrow");
  EXPECT_EQ(trials_, 2);
  EXPECT_EQ(choice().implementation->name, "wide") << "and both are remembered";
  EXPECT_EQ(trials_, 2);
  EXPECT_EQ(lines().size(), 2U);
  EXPECT_EQ(std::distance(fs::directory_iterator(file().parent_path()), {}), 1) << "nothing else is left";
}

TEST_F(Fastest, TheLastSixteenMachines) {
  for (std::size_t i = 0; i < 40; ++i) {
    choice("machine" + std::to_string(i));
    ASSERT_EQ(lines().size(), std::min(i + 1, std::size_t{16}));
  }
  EXPECT_TRUE(lines().front().starts_with("machine24 wide "));
  EXPECT_TRUE(lines().back().starts_with("machine39 wide "));
}

TEST_F(Fastest, NonsenseIsAsNothing) {
  for (const char* text :
       {"", "\n\n", "this", "this ", "this  ", "this wide", "this plain fast\n", "this alien fast\n",
        "this nobody fast\n", "these wide fast\n", "thiswide fast\n", " this wide fast\n"}) {
    write(text);
    trials_ = 0;
    EXPECT_EQ(choice().implementation->name, "wide") << '"' << text << '"';
    EXPECT_EQ(trials_, 1) << '"' << text << '"';
    EXPECT_EQ(choice().implementation->name, "wide");
    EXPECT_EQ(trials_, 1) << "the answer has replaced it";
  }
  write("this wider said\n");
  EXPECT_EQ(choice().implementation->name, "wider");
  EXPECT_EQ(choice().reason, "said");
}

TEST_F(Fastest, NoPlaceToRemember) {
  fs::create_directories(file());  // a folder in its place
  EXPECT_EQ(choice().implementation->name, "wide");
  EXPECT_EQ(choice().implementation->name, "wide");
  EXPECT_EQ(trials_, 2);
  EXPECT_TRUE(fs::is_directory(file()));
  const Choice nowhere = choose(registry_, {}, "this", [&](const auto& all) {
    return std::vector<TrialTime>{{all[0], 1}, {all[1], 2}};
  });
  EXPECT_EQ(nowhere.implementation->name, "narrow");
}

TEST_F(Fastest, OneIsNotTried) {
  step::Registry one;
  one.add({"plain", "", nullptr, true});
  const Trial never = [](const auto&) -> std::vector<TrialTime> { throw std::logic_error("a trial"); };
  EXPECT_EQ(choose(one, file(), "this", never).implementation->name, "plain");
  one.add({"alien", "", nullptr, false});
  EXPECT_EQ(choose(one, file(), "this", never).implementation->name, "plain");
  one.add({"narrow", "", nullptr, true});
  EXPECT_EQ(choose(one, file(), "this", never).implementation->name, "narrow");
  EXPECT_FALSE(fs::exists(file()));
}

// There are two cards, and a device that is none, beside the processor's best.
class Card : public testing::Test {
 protected:
  Card()
      : folder_(fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    processors_.add({"wide", "", nullptr});
    cards_.add({"gpu:0", "", nullptr, true, true, true});
    cards_.add({"gpu:1", "", nullptr, true, true, true});
    cards_.add({"gpu:2", "emulated", nullptr, true, true, false});
  }
  ~Card() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Choice choice(const std::string& machine = "this") {
    const Devices devices = [this]() -> const step::Registry& { return ++looks_, cards_; };
    return choose_for_steps({&processors_.all().front(), "it is wide"}, devices, folder_ / "fastest", machine,
                            [this](const std::vector<const step::Implementation*>& all) {
                              ++trials_;
                              std::vector<TrialTime> times;
                              for (const step::Implementation* one : all)
                                if (seconds_.contains(one->name))
                                  times.push_back({one, seconds_.at(one->name)});
                              return times;
                            });
  }

  fs::path folder_;
  step::Registry processors_, cards_;
  std::map<std::string, double> seconds_{{"wide", 3}, {"gpu:0", 2}, {"gpu:1", 1}, {"gpu:2", 0.1}};
  int looks_ = 0, trials_ = 0;
};

TEST_F(Card, TheFastestWithTheProcessorAsItsSpare) {
  for (int again = 0; again < 3; ++again) {
    const Choice found = choice();
    EXPECT_EQ(found.implementation->name, "gpu:1");
    EXPECT_EQ(found.spare, &processors_.all().front());
    EXPECT_EQ(found.reason,
              "3.00 times as fast as wide, 2.00 times as fast as gpu:0, in a trial of whole steps");
  }
  EXPECT_EQ(trials_, 1) << "the answer is remembered";
}

TEST_F(Card, NoneThatIsSlowerAndNobodyLooksForItAgain) {
  seconds_["wide"] = 0.5;
  for (int again = 0; again < 3; ++again) {
    const Choice found = choice();
    EXPECT_EQ(found.implementation->name, "wide");
    EXPECT_EQ(found.spare, nullptr);
    EXPECT_EQ(found.reason, "it is wide");
  }
  EXPECT_EQ(looks_, 1);
  EXPECT_EQ(trials_, 1);
  seconds_["wide"] = 3;
  EXPECT_EQ(choice("other").implementation->name, "gpu:1") << "a new driver asks for another trial";
}

TEST_F(Card, NoneThatFailsInTheTrial) {
  seconds_.erase("gpu:0");
  seconds_.erase("gpu:1");
  EXPECT_EQ(choice().implementation->name, "wide");
  EXPECT_EQ(choice().reason, "it is wide");
}

TEST_F(Card, NoTrialWithoutOne) {
  cards_ = {};
  cards_.add({"gpu:0", "emulated", nullptr, true, true, false});
  EXPECT_EQ(choice().implementation->name, "wide");
  EXPECT_EQ(choice().implementation->name, "wide");
  EXPECT_EQ(looks_, 1);
  EXPECT_EQ(trials_, 0);
}

TEST_F(Card, ThatIsGoneIsNotTaken) {
  EXPECT_EQ(choice().implementation->name, "gpu:1");
  cards_ = {};
  EXPECT_EQ(choice().implementation->name, "wide");
  EXPECT_EQ(choice().implementation->name, "wide");
}

TEST(Chosen, IsTheFastestOrHasTheName) {
  EXPECT_EQ(chosen("auto").implementation, fastest().implementation);
  EXPECT_EQ(chosen("auto").reason, fastest().reason);
  EXPECT_EQ(chosen("reference").implementation, &implementations().all().front());
  EXPECT_EQ(chosen("reference").reason, "asked for");
  try {
    chosen("abacus");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("unknown; this build has auto, reference, "))
        << error.what();
  }
}

// The trial runs every implementation that this processor has, and the plain one is among them.
TEST(Trial, TimesWhatItRuns) {
  std::vector<const step::Implementation*> able;
  for (const step::Implementation& one : implementations().all())
    if (one.supported) able.push_back(&one);
  const std::vector<TrialTime> times = trial(able);
  ASSERT_EQ(times.size(), able.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(times[i].implementation, able[i]);
    EXPECT_GT(times[i].seconds, 1e-5);
    EXPECT_LT(times[i].seconds, 10);
  }
}

TEST(Trial, OfWholeStepsLeavesOutWhatFails) {
  const auto fails = [](const rule::Parameters&, state::Grid,
                        const step::Tuning&) -> std::unique_ptr<step::Stepper> {
    throw step::DeviceError("it refuses");
  };
  const step::Implementation broken{"gpu:0", "", fails, true, true, true};
  const step::Implementation* const widest = &implementations().widest();
  const std::vector<TrialTime> times = trial_of_steps({widest, &broken, widest});
  ASSERT_EQ(times.size(), 2U);
  for (const TrialTime& one : times) {
    EXPECT_EQ(one.implementation, widest);
    EXPECT_GT(one.seconds, 1e-4);
    EXPECT_LT(one.seconds, 10);
  }
}

}  // namespace
}  // namespace voxmelt::run
