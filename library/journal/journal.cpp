#include "library/journal/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <ios>
#include <ostream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "voxmelt/errors.h"

namespace voxmelt::journal {
namespace {

constexpr std::string_view kSpace = " \t\r";

std::string last_error() { return std::error_code(errno, std::generic_category()).message(); }

// Reads a line that says something.
Line read_line(std::string_view text, std::size_t begin, const std::string& place) {
  const auto fail = [&](std::size_t column, const std::string& what) {
    throw InputError(fmt::format("{}:{}: {}", place, column + 1, what));
  };
  Line line;
  const auto [rest, error] = std::from_chars(text.data() + begin, text.data() + text.size(), line.step);
  const auto end = static_cast<std::size_t>(rest - text.data());
  if (error != std::errc() || end >= text.size() || kSpace.find(text[end]) == kSpace.npos)
    fail(begin, "error: a line begins with a number of steps and a key");
  const std::size_t key = std::min(text.find_first_not_of(kSpace, end), text.size());
  try {
    line.change = read_change(text.substr(end));
  } catch (const InputError& wrong) {
    fail(key, wrong.what());
  }
  line.place = fmt::format("{}:{}", place, key + 1);
  return line;
}

}  // namespace

std::vector<Line> parse_journal(std::string_view text, const std::string& name) {
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::size_t begin = line.find_first_not_of(kSpace);
    if (begin == line.npos || line[begin] == '#') continue;
    const std::string place = fmt::format("{}:{}", name, number);
    Line read = read_line(line, begin, place);
    if (!lines.empty() && read.step < lines.back().step)
      throw InputError(fmt::format("{}:{}: error: step {} comes after step {}", place, begin + 1, read.step,
                                   lines.back().step));
    lines.push_back(std::move(read));
  }
  return lines;
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream && stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
  if (!stream.is_open() || stream.bad() || text.fail())
    throw InputError(fmt::format("error: cannot read {}: {}", file.string(), last_error()));
  return text.str();
}

std::vector<Line> read_journal(const std::filesystem::path& file) {
  return parse_journal(read_text(file), file.string());
}

std::string text_of(const std::vector<Line>& lines) {
  std::string text;
  for (const Line& line : lines) text += fmt::format("{} {}\n", line.step, text_of(line.change));
  return text;
}

void Reader::seek(std::uint32_t step) {
  next_ = 0;
  while (next_ < lines_.size() && lines_[next_].step < step) ++next_;
}

void Reader::apply(World& world, const std::function<void(const Change&)>& tell) {
  for (; next_ < lines_.size() && lines_[next_].step <= world.steps_done(); ++next_) {
    try {
      journal::apply(lines_[next_].change, world);
      if (tell) tell(lines_[next_].change);
    } catch (const InputError& wrong) {
      throw InputError(fmt::format("{}: {}", lines_[next_].place, wrong.what()));
    }
  }
}

std::uint32_t Reader::steps_until_next(std::uint32_t done, std::uint32_t wanted) const {
  if (next_ == lines_.size()) return wanted;
  return std::min(wanted, lines_[next_].step > done ? lines_[next_].step - done : 0);
}

Writer::Writer(const std::filesystem::path& file, const std::string& scene) : file_(file), scene_(scene) {
  restart({});
}

void Writer::restart(const std::vector<Line>& lines) {
  stream_ = std::ofstream(file_);
  stream_ << "# voxmelt journal of " << scene_ << "\n" << text_of(lines) << std::flush;
  if (!stream_) throw OutputError(fmt::format("error: cannot write {}: {}", file_.string(), last_error()));
}

void Writer::write(std::uint32_t step, const Change& change) {
  stream_ << step << ' ' << text_of(change) << "\n" << std::flush;
  if (!stream_) throw OutputError(fmt::format("error: cannot write {}: {}", file_.string(), last_error()));
}

}  // namespace voxmelt::journal
