// The changes of a scene: their order, more of them in its text, and steps that no scene has.
#include "kernel/scene/timeline.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

const std::string kWorld =
    "[grid]\nsize = [2, 2, 2]\n[[liquid]]\nshape = \"box\"\nsize = [1, 1, 1]\nat = [0.5, 0.5, 0.5]\n";

// Returns each change of a scene as "step: words".
std::vector<std::string> changes_of(const std::string& text) {
  std::vector<std::string> all;
  for (const Change& one : SceneFolder().load_text(text).changes)
    all.push_back(std::to_string(one.step) + ": " + one.what);
  return all;
}

TEST(Timeline, ChangesOfAStepStayInTheOrderOfTheFile) {
  EXPECT_EQ(changes_of(kWorld + "[[change]]\nstep = 7\ndo = [\"b\", \"c\"]\n"
                                "[[change]]\nstep = 0\ndo = [\"a\"]\n"
                                "[[change]]\nstep = 7\ndo = [\"d\"]\n"),
            (std::vector<std::string>{"0: a", "7: b", "7: c", "7: d"}));
}

TEST(Timeline, MoreChangesComeBeforeItsOwnOfThatStep) {
  const std::string own = kWorld + "[[change]]\nstep = 3\ndo = [\"own\"]\n";
  EXPECT_EQ(changes_of(with_timeline(own, {{3, "more", ""}, {1, "first", ""}})),
            (std::vector<std::string>{"1: first", "3: more", "3: own"}));
}

TEST(Timeline, NoChangeIsBeyondTheLastStep) {
  const std::string text = kWorld + "[start]\nstep = 4294967290\n";
  EXPECT_NE(with_timeline(text, {{5, "last", ""}}).find("step = 4294967295\n"), std::string::npos);
  try {
    with_timeline(text, {{6, "too late", ""}});
    FAIL() << "it was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "error: a change after 6 steps of a scene that begins at step 4294967290 is beyond the last "
              "one, 4294967295");
  }
}

}  // namespace
}  // namespace voxmelt::scene
