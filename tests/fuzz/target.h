// The targets share a file of their own in a folder of their own, and the rule for a reader of hostile bytes.
// It reads them, or throws InputError or ResourceError with one line.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>
#include <system_error>

#include "kernel/scene/scene.h"

namespace voxmelt::fuzz {

[[noreturn]] inline void found(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

// Returns the target's own folder, which is removed when the process ends. It is in memory if it can be: a
// disk takes milliseconds for each file that is written anew.
inline const std::filesystem::path& folder() {
  struct Own {
    Own() {
      const std::filesystem::path memory = "/dev/shm";
      const bool has = ::access(memory.c_str(), W_OK) == 0;
      std::string name =
          ((has ? memory : std::filesystem::temp_directory_path()) / "voxmelt-fuzz-XXXXXX").string();
      if (::mkdtemp(name.data()) == nullptr) found("no folder for the target");
      path = name;
    }
    ~Own() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
  };
  static const Own own;
  return own.path;
}

inline std::filesystem::path write(const std::string& name, std::string_view bytes) {
  const std::filesystem::path file = folder() / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// An argument of the command line ends at a NUL.
inline std::string argument(std::string_view text) { return std::string(text.substr(0, text.find('\0'))); }

// A message is a line for the terminal: text, without its line break, and it says that it is an error.
inline void check_message(const std::string& message) {
  if (message.find("error") == std::string::npos) found("a message without `error`: " + message);
}

template <class Read>
void try_to(const Read& read) {
  try {
    read();
  } catch (const scene::InputError& error) {
    check_message(error.what());
  } catch (const scene::ResourceError& error) {
    check_message(error.what());
  }
}

}  // namespace voxmelt::fuzz
