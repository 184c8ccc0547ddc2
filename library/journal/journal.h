// A journal holds the changes that were made by hand, a line each: "STEP KEY NUMBER ...". STEP is the number
// of steps that were done before. Empty lines and lines that begin with # say nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "library/journal/change.h"

namespace voxmelt::journal {

struct Line {
  std::uint32_t step = 0;
  Change change;
  std::string place;  // file:line:column, for messages
};

// Throws InputError with file:line:column. Steps may not descend.
std::vector<Line> read_journal(const std::filesystem::path& file);
std::string read_text(const std::filesystem::path& file);                         // throws InputError
std::vector<Line> parse_journal(std::string_view text, const std::string& name);  // the name is for messages
std::string text_of(const std::vector<Line>& lines);  // parse_journal() gives the same lines again

// Makes the changes of a journal when their step has come.
class Reader {
 public:
  explicit Reader(std::vector<Line> lines) : lines_(std::move(lines)) {}

  // Applies all lines of this step, and tells each of them. Throws InputError with the place of a line that
  // the world refuses.
  void apply(World& world, const std::function<void(const Change&)>& tell = {});
  // Returns how many steps may be run until the next line, at most `wanted`.
  std::uint32_t steps_until_next(std::uint32_t done, std::uint32_t wanted) const;
  bool at_end() const { return next_ == lines_.size(); }
  void seek(std::uint32_t step);  // goes on with the lines from this step on

 private:
  std::vector<Line> lines_;
  std::size_t next_ = 0;
};

// Writes each change at once, so that nothing is lost when the program is killed.
class Writer {
 public:
  // Throws OutputError.
  Writer(const std::filesystem::path& file, const std::string& scene);
  void write(std::uint32_t step, const Change& change);
  void restart(const std::vector<Line>& lines);  // forgets all but these

 private:
  std::filesystem::path file_;
  std::string scene_;
  std::ofstream stream_;
};

}  // namespace voxmelt::journal
