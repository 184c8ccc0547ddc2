// A checkpoint is a file of blocks. Each is packed by zstd, and has a checksum that covers it and its header
// (docs/checkpoint.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/run/io/file_writer.h"

namespace voxmelt::checkpoint {

// Is thrown for a file that is no checkpoint, or no whole one: exit code 2. The message begins with the
// file's name.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why);

using Bytes = std::vector<std::byte>;

struct BlockName {
  std::string kind;  // at most 8 letters
  std::uint32_t first = 0, count = 0;
  friend bool operator==(const BlockName&, const BlockName&) = default;
};

// Returns XXH3, 64 bits.
std::uint64_t checksum(std::span<const std::byte> bytes);
std::uint64_t checksum_of_file(const std::filesystem::path& file);  // throws Error

// Holds a block as it is stored. A block of zeros alone is stored as nothing.
struct Packed {
  std::uint64_t raw_bytes = 0;
  Bytes stored;
};
Packed packed(std::span<const std::byte> raw);

class BlockWriter {
 public:
  // Writes beside `place`. The file appears there with finish(), and without it nothing is left. It throws
  // io::OutputError, as do the functions below.
  explicit BlockWriter(const std::filesystem::path& place);

  void put(const BlockName& name, const Packed& block);
  // Writes the last block. Then the file is on the disk, and in its place.
  void finish();

 private:
  void write(const void* bytes, std::size_t count);

  std::filesystem::path place_;
  io::FileWriter file_;
  std::uint32_t blocks_ = 0;
  Bytes checksums_;
};

class BlockReader {
 public:
  // Opens a file, whose version is one that this program reads. It throws Error, as do the functions below.
  explicit BlockReader(const std::filesystem::path& file);

  // Reads the next block, which must have this name, and at most so many bytes. The block is whole.
  Bytes next(const BlockName& name, std::uint64_t most);
  // Reads a block of a known number of bytes into `raw`. It returns true if all of it is 0. Then `raw` is not
  // written.
  bool next_is_empty(const BlockName& name, std::span<std::byte> raw);
  // Tells if the next block is of this kind. It is not read.
  bool next_is(std::string_view kind);
  // Reads the last block, and checks that nothing comes behind it.
  void finish();

  // Lists every block as it stands in the file, each of them whole.
  struct Listed {
    BlockName name;
    std::uint64_t raw_bytes = 0, stored_bytes = 0;
  };
  static std::vector<Listed> list(const std::filesystem::path& file);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Header {
    BlockName name;
    std::uint64_t raw_bytes = 0;
    Bytes stored;
  };
  void read(void* bytes, std::size_t count);
  Header take();
  Header take(const BlockName& name);
  void unpack(const Header& block, std::span<std::byte> raw) const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t left_ = 0;  // bytes of the file that are not read yet
  std::uint32_t blocks_ = 0;
  Bytes checksums_;
};

}  // namespace voxmelt::checkpoint
