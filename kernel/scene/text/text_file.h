// Reads a whole file up to a limit of its size. A failure is one clear line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// The bytes of `file`. Throws InputError "<where>: error: ..." when it is missing, a folder, larger than
// `limit`, or a pipe through which nothing comes for a while.
std::string read_text_file(const std::filesystem::path& file, std::size_t limit, const std::string& where);

// The text without the mark that some programs write before UTF-8. Throws InputError naming `place` and
// `file` where it is UTF-16.
std::string_view without_mark(std::string_view text, const Place& place, const std::string& file);

// While one lives, it notes the files that this thread reads; the innermost one notes.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;
  const std::vector<std::filesystem::path>& files() const { return files_; }
  static void note(const std::filesystem::path& file);

 private:
  std::vector<std::filesystem::path> files_;
  FilesRead* outer_;
};

}  // namespace voxmelt::scene
