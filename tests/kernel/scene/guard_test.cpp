// The guard refuses documents that the TOML parser must not see, and lets all others pass that TOML allows.
#include "kernel/scene/text/guard.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace voxmelt::scene {
namespace {

// Returns a dotted key of so many parts.
std::string key_of(int parts) { return fmt::format("{}", fmt::join(std::vector<char>(parts, 'a'), ".")); }

TEST(Guard, LetsGoodDocumentsPass) {
  const std::vector<std::string> good{
      "",
      "a = 1 # ä, [ and 'x\n",
      "a = 'ä [[[ \" #'\nb = \"ä \\\" [\"\n",
      "a = '''\nä\n[\n''''\nb = \"\"\"\n\xc3\xa4 \\\"\"\" [\n\"\"\"\"\"\n",
      "\xef\xbb\xbf[grid]\nsize = [\n  1, # one\n  2\n]\n",
      "[[solid]]\r\nat = [0.5, 1.5]\r\n",
      "a.\"b.c\".d = { e = [1.5, 2.5] }\n",
      "a = \"\"\n[ b ]\n",
      "[a.'b'.\"c\"]\n'd'.\"e\" = {'f'.g.'h' = 1.5, 'i'.'j' = ['k', 'l',\n'm'], n.'o'='p'} # it's\n'q'='r'\n",
      "a = [{b.'c' = 'd'}, {'e'.f = [1.5,'g']}]\n[[h]]\n'i'.'j' = 1979-05-27 07:32:00\n",
      fmt::format("a = {:[>64}{:]>64}", "", ""),
      fmt::format("{} = 1.5\n", key_of(64)),
  };
  for (const std::string& text : good) EXPECT_EQ(object_to(text).text, "") << text;
}

struct Bad {
  std::string text;
  std::size_t line, column;
};

TEST(Guard, ObjectsAtTheirPlaces) {
  const std::string dots = key_of(65);
  const std::vector<Bad> bad{
      {"a = \xc3\xa4\n", 1, 5},
      {"a = 'x'\n# ä\nb = \"\"\"\n\n\"\"\" \xc9\xa2", 5, 5},
      {"[\n", 1, 1},
      {"a = 1\n  [[ \t\n", 2, 3},
      {"[ # x\n", 1, 1},
      {"a = 1\x01\n", 1, 6},
      {"a = 1\x7f\n", 1, 6},
      {std::string{"a = \0 1", 7}, 1, 5},
      {"a = 0989-05-27T'\xd2\x9e'\n", 1, 16},
      {"a = 'b''\xd2\x9e'\n", 1, 8},
      {"a = 1.'\xd2\x9e'\n", 1, 7},
      {"a = [1, true.\"\xd2\x9e\"]\n", 1, 14},
      {"a = {b.'c' = 1.'\xd2\x9e'}\n", 1, 16},
      {"a\"\xd2\x9e\" = 1\n", 1, 2},
      {fmt::format("{} = 1\n", dots), 1, 128},
      {fmt::format("[{}]\n", dots), 1, 1 + 128},
      {fmt::format("x = {{ {} = 1 }}", dots), 1, 6 + 128},
      {fmt::format("a = [\n{:[>64}", ""), 2, 64},
      {fmt::format("a = {}", std::string(65, '{')), 1, 69},
  };
  for (const Bad& one : bad) {
    const Objection objection = object_to(one.text);
    EXPECT_NE(objection.text, "") << one.text;
    EXPECT_EQ(objection.line, one.line) << one.text;
    EXPECT_EQ(objection.column, one.column) << one.text;
  }
}

}  // namespace
}  // namespace voxmelt::scene
