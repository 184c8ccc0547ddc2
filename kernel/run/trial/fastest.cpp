#include "kernel/run/trial/fastest.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "kernel/run/implementations.h"

namespace voxmelt::run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRemembered = 16;  // lines kept: two for each build and processor

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

// Tells if the system knows a card of any kind. Elsewhere no driver is looked for, which takes a moment.
bool may_have_card() {
  std::error_code none;
  return std::ranges::any_of(std::array{"/dev/dri", "/dev/nvidia0", "/dev/kfd", "/dev/dxg"},
                             [&](const char* node) { return fs::exists(node, none); });
}

// Returns the drivers of OpenCL that are installed, in hexadecimal digits: a new one asks for another trial.
// To look for their devices would take longer.
std::string drivers() {
  std::vector<std::string> found;
  const char* elsewhere = std::getenv("OCL_ICD_VENDORS");
  std::error_code none;
  for (const auto& entry :
       fs::directory_iterator(elsewhere != nullptr ? elsewhere : "/etc/OpenCL/vendors", none)) {
    struct stat driver {};
    stat(entry.path().c_str(), &driver);
    found.push_back(fmt::format("{} {}", entry.path().string(), driver.st_mtim.tv_sec));
  }
  std::ranges::sort(found);
  return fmt::format("-{:016x}", std::hash<std::string>()(fmt::format("{}", fmt::join(found, "\n"))));
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

struct Remembered {
  std::string name, reason;
};
constexpr const char* kNoCard = "processor";  // no implementation has this name

// Returns what the line of a machine says.
std::optional<Remembered> remembered(const fs::path& file, const std::string& machine) {
  for (const std::string& line : lines_of(file)) {
    if (!line.starts_with(machine + ' ')) continue;
    const std::size_t name = machine.size() + 1, end = line.find(' ', name);
    if (end != std::string::npos) return Remembered{line.substr(name, end - name), line.substr(end + 1)};
  }
  return {};
}

// Writes the file. Another program may do the same at the same moment. Each writes a file of its own, and the
// last one wins.
void remember(const fs::path& file, const std::string& machine, const Remembered& what) {
  if (file.empty()) return;
  std::vector<std::string> lines = lines_of(file);
  std::erase_if(lines, [&](const std::string& line) { return line.starts_with(machine + ' '); });
  lines.push_back(fmt::format("{} {} {}", machine, what.name, what.reason));
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

Choice best_of(const std::vector<TrialTime>& times, const char* where) {
  const auto faster = [](const TrialTime& a, const TrialTime& b) { return a.seconds < b.seconds; };
  const auto best = std::min_element(times.begin(), times.end(), faster);
  std::string others;
  for (const TrialTime& other : times)
    if (&other != &*best)
      others += fmt::format("{}{:.2f} times as fast as {}", others.empty() ? "" : ", ",
                            other.seconds / best->seconds, other.implementation->name);
  return {best->implementation, fmt::format("{}, {}", others, where)};
}

}  // namespace

Choice choose(const step::Registry& registry, const fs::path& file, const std::string& machine,
              const Trial& trial) {
  std::vector<const step::Implementation*> able;  // all but the first, the reference, which is slow
  for (const step::Implementation& one : registry.all())
    if (one.supported && &one != &registry.all().front()) able.push_back(&one);
  if (able.empty()) return {&registry.all().front(), "this processor has no other"};
  if (able.size() == 1) return {able.front(), "the only one for this processor"};

  if (const std::optional<Remembered> last = remembered(file, machine)) {
    const auto known = std::ranges::find(able, last->name, &step::Implementation::name);
    if (known != able.end()) return {*known, last->reason};
  }
  const Choice choice = best_of(trial(able), "in a trial on this processor");
  remember(file, machine, {choice.implementation->name, choice.reason});
  return choice;
}

Choice choose_for_steps(const Choice& processor, const Devices& devices, const fs::path& file,
                        const std::string& machine, const Trial& trial) {
  const std::optional<Remembered> last = remembered(file, machine);
  if (last && last->name == kNoCard) return processor;
  std::vector<const step::Implementation*> able{processor.implementation};
  for (const step::Implementation& one : devices().all())
    if (one.is_card) able.push_back(&one);
  const auto with_spare = [&](Choice choice) {
    if (choice.implementation != processor.implementation) choice.spare = processor.implementation;
    return choice;
  };
  if (last)
    for (const step::Implementation* one : able)
      if (one->is_card && one->name == last->name) return with_spare({one, last->reason});
  const Choice best = able.size() > 1 ? best_of(trial(able), "in a trial of whole steps") : processor;
  const bool card = best.implementation != processor.implementation;
  remember(file, machine, {card ? best.implementation->name : kNoCard, best.reason});
  return card ? with_spare(best) : processor;
}

const Choice& fastest() {
  static const Choice choice = choose(implementations(), cache_file(), this_machine(), trial);
  return choice;
}

const Choice& fastest_for_steps() {
  static const Choice choice =
      !may_have_card()
          ? fastest()
          : choose_for_steps(fastest(), devices, cache_file(), this_machine() + drivers(), trial_of_steps);
  return choice;
}

namespace {

Choice device_named(const std::string& name) {
  const std::vector<step::Implementation>& all = devices().all();
  if (name.starts_with("gpu:cuda"))
    if (const std::string missing = missing_for_cuda(); !missing.empty())
      throw std::invalid_argument(missing);
  if (all.empty()) throw std::invalid_argument("this machine has no device of OpenCL or CUDA");
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
