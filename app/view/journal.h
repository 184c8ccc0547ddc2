// A journal holds the changes that were made by hand, a line each: "STEP KEY NUMBER ...". STEP is the number
// of steps that were done before. Empty lines and lines that begin with # say nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/change.h"

namespace voxmelt::view {

struct JournalLine {
  std::uint32_t step = 0;
  Change change;
  std::string place;  // file:line, for messages
};

// Throws InputError with file:line:column. Steps may not descend.
std::vector<JournalLine> read_journal(const std::filesystem::path& file);

// Makes the changes of a journal when their step has come.
class JournalReader {
 public:
  explicit JournalReader(std::vector<JournalLine> lines) : lines_(std::move(lines)) {}

  // Applies all lines of this step, and tells each of them. Throws InputError with the place of a line that
  // the simulation refuses.
  void apply(Simulation& simulation, const std::function<void(const Change&)>& tell = {});
  // Returns how many steps may be run until the next line, at most `wanted`.
  std::uint32_t steps_until_next(std::uint32_t done, std::uint32_t wanted) const;
  bool at_end() const { return next_ == lines_.size(); }
  void rewind() { next_ = 0; }

 private:
  std::vector<JournalLine> lines_;
  std::size_t next_ = 0;
};

// Writes each change at once, so that nothing is lost when the program is killed.
class JournalWriter {
 public:
  // Throws OutputError.
  JournalWriter(const std::filesystem::path& file, const std::string& scene);
  void write(std::uint32_t step, const Change& change);
  void restart();  // forgets all

 private:
  std::filesystem::path file_;
  std::string scene_;
  std::ofstream stream_;
};

}  // namespace voxmelt::view
