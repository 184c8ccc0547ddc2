// A whole file is read up to a limit of its size. A failure is one clear line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Returns the bytes of `file`. It throws InputError "<where>: error: ..." if the file is missing, a folder,
// larger than `limit`, or a pipe through which nothing comes for a while.
std::string read_text_file(const std::filesystem::path& file, std::size_t limit, const std::string& where);

// Returns the text without the mark that some programs write before UTF-8. It throws InputError with `place`
// and `file` if the text is UTF-16, an archive, or a pointer to a file that is kept elsewhere (Git LFS).
std::string_view without_mark(std::string_view text, const Place& place, const std::string& file);

// Returns the character that ends lines: '\n', or '\r' in a text that has none of the former.
char line_end_of(std::string_view text);

// Returns the begin of a word, in quotes. Control characters are spelt out, because the message of an
// exception ends at a NUL byte.
std::string in_quotes(std::string_view word);

// Reads a number and nothing else, by no locale. A sign + may stand before it. It is infinite if it is too
// large for its type, and 0 if it is too small. Nothing is returned if the word is no number.
std::optional<double> real_number_in(std::string_view word);

// Notes the files that this thread reads, while it lives. The innermost one notes.
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
