#include "kernel/run/trial/fastest.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "kernel/run/implementations.h"

namespace voxmelt::run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRemembered = 8;  // lines kept, for builds and processors

// Returns the first processor's lines, less those that change from moment to moment.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string text, line;
  while (std::getline(file, line) && !line.empty())
    if (!line.starts_with("cpu MHz") && !line.starts_with("BogoMIPS") && !line.starts_with("bogomips"))
      text += line + '\n';
  return text;
}

// Returns program and processor, in 16 hexadecimal digits.
std::string this_machine() {
  struct stat program {};
  stat("/proc/self/exe", &program);
  const std::string build =
      fmt::format("{} {} {}", program.st_size, program.st_mtim.tv_sec, program.st_mtim.tv_nsec);
  return fmt::format("{:016x}", std::hash<std::string>()(build + '\n' + processor()));
}

fs::path cache_file() {
  if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder != nullptr && *folder == '/')
    return fs::path(folder) / "voxmelt" / "fastest";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".cache" / "voxmelt" / "fastest";
  return {};
}

// Returns the lines of a file. A line is: machine, name, reason.
std::vector<std::string> lines_of(const fs::path& file) {
  std::error_code none;
  if (file.empty() || !fs::is_regular_file(file, none)) return {};
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; lines.size() < 2 * kRemembered && std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Writes the file. Another program may do the same at the same moment. Each writes a file of its own, and the
// last one wins.
void remember(const fs::path& file, std::vector<std::string> lines) {
  if (file.empty()) return;
  if (lines.size() > kRemembered) lines.erase(lines.begin(), lines.end() - kRemembered);
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  const fs::path partial = fmt::format("{}.{}", file.string(), getpid());
  {
    std::ofstream out(partial);
    for (const std::string& line : lines) out << line << '\n';
    out.close();
    if (!out) failed = std::make_error_code(std::errc::io_error);
  }
  if (!failed) fs::rename(partial, file, failed);
  if (failed) fs::remove(partial, failed);
}

Choice best_of(const std::vector<TrialTime>& times) {
  const auto faster = [](const TrialTime& a, const TrialTime& b) { return a.seconds < b.seconds; };
  const auto best = std::min_element(times.begin(), times.end(), faster);
  std::string others;
  for (const TrialTime& other : times)
    if (&other != &*best)
      others += fmt::format("{}{:.2f} times as fast as {}", others.empty() ? "" : ", ",
                            other.seconds / best->seconds, other.implementation->name);
  return {best->implementation, others + ", in a trial on this processor"};
}

}  // namespace

Choice choose(const step::Registry& registry, const fs::path& file, const std::string& machine,
              const Trial& trial) {
  std::vector<const step::Implementation*> able;  // all but the first, the reference, which is slow
  for (const step::Implementation& one : registry.all())
    if (one.supported && &one != &registry.all().front()) able.push_back(&one);
  if (able.empty()) return {&registry.all().front(), "this processor has no other"};
  if (able.size() == 1) return {able.front(), "the only one for this processor"};

  std::vector<std::string> lines = lines_of(file);
  for (const std::string& line : lines) {
    if (!line.starts_with(machine + ' ')) continue;
    const std::size_t name = machine.size() + 1, end = line.find(' ', name);
    const auto known = std::find_if(able.begin(), able.end(), [&](const step::Implementation* one) {
      return end != std::string::npos && line.compare(name, end - name, one->name) == 0;
    });
    if (known != able.end()) return {*known, line.substr(end + 1)};
  }
  const Choice choice = best_of(trial(able));
  std::erase_if(lines, [&](const std::string& line) { return line.starts_with(machine + ' '); });
  lines.push_back(fmt::format("{} {} {}", machine, choice.implementation->name, choice.reason));
  remember(file, std::move(lines));
  return choice;
}

const Choice& fastest() {
  static const Choice choice = choose(implementations(), cache_file(), this_machine(), trial);
  return choice;
}

namespace {

Choice device_named(const std::string& name) {
  const std::vector<step::Implementation>& all = devices().all();
  if (all.empty()) throw std::invalid_argument("this machine has no device of OpenCL");
  const step::Implementation* found = name == "gpu" ? &all.front() : devices().find(name);
  if (found == nullptr)
    throw std::invalid_argument("this machine has " + all.front().name +
                                (all.size() > 1 ? " to " + all.back().name : " alone"));
  return {found, "asked for"};
}

}  // namespace

Choice chosen(const std::string& name) {
  if (name == "auto") return fastest();
  if (name == "gpu" || name.starts_with("gpu:")) return device_named(name);
  const step::Implementation* found = implementations().find(name);
  if (found == nullptr) {
    std::string known = "auto";
    for (const step::Implementation& one : implementations().all()) known += ", " + one.name;
    throw std::invalid_argument("unknown; this build has " + known);
  }
  if (!found->supported) throw std::invalid_argument("this processor does not have it");
  return {found, "asked for"};
}

}  // namespace voxmelt::run
