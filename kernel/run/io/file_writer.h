// An output file is never half-written. It is filled piece by piece beside its place, flushed and renamed.
#pragma once

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "kernel/run/io/unfinished.h"

namespace voxmelt::io {

// Is thrown if output cannot be written (exit code 2), or the disk is full (exit code 3).
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& message, bool out_of_space)
      : std::runtime_error(message), out_of_space_(out_of_space) {}
  bool out_of_space() const { return out_of_space_; }

 private:
  bool out_of_space_;
};

// Throws OutputError: "<path>: error: <what>: <the system's reason>".
[[noreturn]] void fail_output(const std::filesystem::path& path, const std::string& what, int error);

// Makes a folder and those above it, unless they are there.
void make_folder(const std::filesystem::path& folder);

// Names a new file or folder beside `place`, for its partial state, as a template of mkstemp and mkdtemp.
std::string beside(const std::filesystem::path& place);

class FileWriter {
 public:
  // Opens a place for writing. A device, a pipe or a link (/dev/stdout) is written as it is. A file is
  // replaced whole by commit().
  explicit FileWriter(const std::filesystem::path& place);
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;
  ~FileWriter();  // removes what was not committed

  void write(std::string_view bytes);
  void commit();

 private:
  std::filesystem::path place_;
  std::string partial_;  // the name of the file that is open
  bool replace_ = false;
  std::FILE* file_ = nullptr;
  Unfinished unfinished_;
};

// Writes all of a file at once.
void write_file(const std::filesystem::path& place, const std::string& bytes);

}  // namespace voxmelt::io
