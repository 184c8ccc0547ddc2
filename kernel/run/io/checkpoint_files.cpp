#include "kernel/run/io/checkpoint_files.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace voxmelt::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBegin = "step_", kSuffix = ".vxc";

std::optional<std::uint32_t> number_of(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(kBegin) || !name.ends_with(kSuffix)) return {};
  const char* const begin = name.data() + kBegin.size();
  const char* const end = name.data() + name.size() - kSuffix.size();
  std::uint32_t number = 0;
  const auto [last, error] = std::from_chars(begin, std::max(begin, end), number);
  return error == std::errc() && last == end ? std::optional(number) : std::nullopt;
}

}  // namespace

fs::path checkpoint_place(const fs::path& folder, std::uint32_t step) {
  char name[32];
  std::snprintf(name, sizeof name, "step_%08u.vxc", step);
  return folder / "checkpoints" / name;
}

std::vector<CheckpointFile> checkpoints_in(const fs::path& folder) {
  std::vector<CheckpointFile> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "checkpoints", ignored))
    if (const auto step = number_of(entry.path())) files.push_back({*step, entry.path()});
  std::ranges::sort(files, std::greater(), &CheckpointFile::step);
  return files;
}

bool holds_work(const fs::path& folder) {
  const std::vector<CheckpointFile> files = checkpoints_in(folder);
  return !files.empty() && files.front().step > 0;
}

void remove_output(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder / "checkpoints", ignored);
  fs::remove_all(folder, ignored);
}

void keep_two_checkpoints(const fs::path& folder) {
  const std::vector<CheckpointFile> files = checkpoints_in(folder);
  std::error_code ignored;
  for (std::size_t i = 2; i < files.size(); ++i) fs::remove(files[i].file, ignored);
  std::vector<fs::path> half_written;
  for (const auto& entry : fs::directory_iterator(folder / "checkpoints", ignored))
    if (!number_of(entry.path())) half_written.push_back(entry.path());
  for (const fs::path& file : half_written) fs::remove(file, ignored);
}

}  // namespace voxmelt::io
