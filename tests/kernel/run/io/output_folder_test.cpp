// Output folders are made among living and dead processes, old outputs, and foreign files.
#include "kernel/run/io/output_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>

namespace voxmelt::io {
namespace {

namespace fs = std::filesystem;

class OutputFolders : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "voxmelt-folders-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    place_ = folder_ / "out";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.insert(entry.path().filename().string());
    return all;
  }
  std::string read(const fs::path& file) const {
    std::ifstream stream(folder_ / file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  void make(const std::string& text) const {
    OutputFolder out(place_);
    write_file(out.partial() / "a", text);
    out.commit();
  }
  // Runs a process that begins an output. It is killed, or lives until `meanwhile` has returned.
  void with_another_process(const std::function<void()>& meanwhile, bool dead) const {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      const OutputFolder out(place_);
      write_file(out.partial() / "half", "?");
      (void)::write(ready[1], "x", 1);
      ::pause();
      ::_exit(1);
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    const auto end = [&] {
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
    };
    if (dead) end();
    meanwhile();
    if (!dead) end();
    ::close(ready[0]);
    ::close(ready[1]);
  }

  fs::path folder_, place_;
};

TEST_F(OutputFolders, WhatADeadProcessLeftIsRemoved) {
  with_another_process(
      [&] {
        EXPECT_EQ(names().size(), 1U);
        make("1");
        EXPECT_EQ(names(), std::set<std::string>{"out"});
      },
      true);
}

// A process dies while it moves entries, after each of its steps. The next one completes the move.
TEST_F(OutputFolders, AMoveThatBrokeOffIsCompleted) {
  make("old");
  const fs::path fresh = folder_ / "out.partial-abcdef";
  const auto prepare = [&] {
    fs::remove_all(folder_);
    make("old");
    write_file(place_ / "gone", "old");  // the new contents do not have it
    fs::create_directories(fresh);
    write_file(fresh / "a", "new");
    write_file(fresh / ".voxmelt-output", "a\n");
  };
  const auto complete = [&] {
    clear_leavings(place_);
    EXPECT_EQ(read("out/a"), "new");
    EXPECT_EQ(read("out/.voxmelt-output"), "a\n");
    EXPECT_FALSE(fs::exists(place_ / "gone"));
    EXPECT_EQ(names(), std::set<std::string>{"out"});
  };
  prepare();
  fs::create_directory(fresh / ".voxmelt-old");
  complete();
  prepare();
  fs::create_directory(fresh / ".voxmelt-old");
  fs::rename(place_ / "a", fresh / ".voxmelt-old/a");
  complete();
  prepare();
  fs::rename(place_, fresh / ".voxmelt-old");
  fs::create_directory(place_);
  write_file(fresh / ".voxmelt-moving", "");
  fs::rename(fresh / "a", place_ / "a");
  complete();
}

TEST_F(OutputFolders, ALivingProcessIsNotDisturbed) {
  make("1");
  with_another_process(
      [&] {
        const std::set<std::string> before = names();
        EXPECT_EQ(before.size(), 2U);
        EXPECT_THROW(OutputFolder{place_}, OutputError);
        EXPECT_EQ(names(), before);
        OutputFolder beside(folder_ / "out2");  // only the first part of its name is the same
        beside.commit();
      },
      false);
  EXPECT_EQ(read("out/a"), "1");
  make("2");
  EXPECT_EQ(read("out/a"), "2");
  EXPECT_EQ(names(), (std::set<std::string>{"out", "out2"}));
}

TEST_F(OutputFolders, AFileThatCameMeanwhileIsKept) {
  make("1");
  OutputFolder out(place_);
  std::ofstream(place_ / "letter") << "dear";
  EXPECT_THROW(out.commit(), OutputError);
  EXPECT_EQ(read("out/letter"), "dear");
  EXPECT_EQ(read("out/a"), "1");
}

TEST_F(OutputFolders, FilesOfDesktopsAreNoReasonToRefuse) {
  make("1");
  std::ofstream(place_ / ".DS_Store") << "icons";
  make("2");
  EXPECT_EQ(read("out/a"), "2");
  EXPECT_FALSE(fs::exists(place_ / ".DS_Store"));
}

TEST_F(OutputFolders, AnIncompleteOneLeavesTheOldOneAlone) {
  make("1");
  OutputFolder out(place_);
  write_file(out.partial() / "a", "half");
  out.release_reserve();
  EXPECT_EQ(out.keep_incomplete(), fs::weakly_canonical(place_).string() + ".incomplete");
  EXPECT_EQ(read("out/a"), "1");
  EXPECT_EQ(read("out.incomplete/a"), "half");
  EXPECT_EQ(names(), (std::set<std::string>{"out", "out.incomplete"}));
  make("2");  // the next complete output does not mind it
  EXPECT_EQ(read("out/a"), "2");
}

TEST_F(OutputFolders, HoldNothingOfOurBookkeepingButTheMarker) {
  make("1");
  std::set<std::string> inside;
  for (const auto& entry : fs::directory_iterator(place_)) inside.insert(entry.path().filename().string());
  EXPECT_EQ(inside, (std::set<std::string>{".voxmelt-output", "a"}));
  EXPECT_EQ(read("out/.voxmelt-output"), "a\n");
}

TEST_F(OutputFolders, FilesHaveTheUsualRights) {
  const mode_t before = ::umask(027);
  write_file(folder_ / "f", "1");
  const OutputFolder out(place_);
  EXPECT_EQ(fs::status(folder_ / "f").permissions(), fs::perms{0640});
  EXPECT_EQ(fs::status(out.partial()).permissions(), fs::perms{0750});
  ::umask(before);
}

}  // namespace
}  // namespace voxmelt::io
