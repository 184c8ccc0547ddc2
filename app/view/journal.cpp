#include "app/view/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <ostream>
#include <string_view>
#include <system_error>
#include <utility>

namespace voxmelt::view {
namespace {

constexpr std::string_view kSpace = " \t\r";

std::string last_error() { return std::error_code(errno, std::generic_category()).message(); }

}  // namespace

std::vector<JournalLine> read_journal(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("error: cannot read {}: {}", file.string(), last_error()));
  std::vector<JournalLine> lines;
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    std::string_view line = text;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::size_t begin = line.find_first_not_of(kSpace);
    if (begin == line.npos || line[begin] == '#') continue;
    const auto fail = [&](std::size_t column, const std::string& what) {
      throw InputError(fmt::format("{}:{}:{}: {}", file.string(), number, column + 1, what));
    };
    JournalLine read;
    const auto [rest, error] = std::from_chars(line.data() + begin, line.data() + line.size(), read.step);
    const auto end = static_cast<std::size_t>(rest - line.data());
    if (error != std::errc() || end >= line.size() || kSpace.find(line[end]) == kSpace.npos)
      fail(begin, "error: a line begins with a number of steps and a key");
    if (!lines.empty() && read.step < lines.back().step)
      fail(begin, fmt::format("error: step {} comes after step {}", read.step, lines.back().step));
    const std::size_t key = std::min(line.find_first_not_of(kSpace, end), line.size());
    try {
      read.change = read_change(line.substr(end));
    } catch (const InputError& wrong) {
      fail(key, wrong.what());
    }
    read.place = fmt::format("{}:{}:{}", file.string(), number, key + 1);
    lines.push_back(std::move(read));
  }
  return lines;
}

void JournalReader::apply(Simulation& simulation, const std::function<void(const Change&)>& tell) {
  for (; next_ < lines_.size() && lines_[next_].step <= simulation.steps_done(); ++next_) {
    try {
      view::apply(lines_[next_].change, simulation);
      if (tell) tell(lines_[next_].change);
    } catch (const InputError& wrong) {
      throw InputError(fmt::format("{}: {}", lines_[next_].place, wrong.what()));
    }
  }
}

std::uint32_t JournalReader::steps_until_next(std::uint32_t done, std::uint32_t wanted) const {
  if (next_ == lines_.size()) return wanted;
  return std::min(wanted, lines_[next_].step > done ? lines_[next_].step - done : 0);
}

JournalWriter::JournalWriter(const std::filesystem::path& file, const std::string& scene)
    : file_(file), scene_(scene) {
  restart();
}

void JournalWriter::restart() {
  stream_ = std::ofstream(file_);
  stream_ << "# voxmelt journal of " << scene_ << "\n" << std::flush;
  if (!stream_) throw OutputError(fmt::format("error: cannot write {}: {}", file_.string(), last_error()));
}

void JournalWriter::write(std::uint32_t step, const Change& change) {
  stream_ << step << ' ' << text_of(change) << "\n" << std::flush;
  if (!stream_) throw OutputError(fmt::format("error: cannot write {}: {}", file_.string(), last_error()));
}

}  // namespace voxmelt::view
