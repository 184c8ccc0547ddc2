// The target reads a checkpoint. Checksums refuse nearly every changed byte, so the target makes them fit:
// behind them lie the readers of blocks, of the head, of cells and of the run's record. The input is a file
// as it stands, or text that the target packs. That has a line `KIND FIRST COUNT`, then a line that the block
// holds. Cells are hexadecimal digits.
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "app/run_record.h"
#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/opening/checkpoint_scene.h"
#include "tests/fuzz/target.h"

namespace {

using namespace voxmelt;
using checkpoint::Bytes;

constexpr std::size_t kBegin = 16, kHeader = 32, kSum = 8;

std::uint64_t number_at(const std::string& file, std::size_t at) {
  std::uint64_t number = 0;
  std::memcpy(&number, file.data() + at, sizeof number);
  return number;
}

void put_number(std::string& file, std::size_t at, std::uint64_t number) {
  std::memcpy(file.data() + at, &number, sizeof number);
}

// Gives the blocks the checksums that they should have. The last one, which holds those of the others, gets
// its own, too.
void make_checksums_fit(std::string& file) {
  std::string sums;
  for (std::size_t at = kBegin; at + kHeader + kSum <= file.size();) {
    const std::size_t from = at + kHeader + kSum;
    const std::uint64_t stored = std::min<std::uint64_t>(number_at(file, at + 24), file.size() - from);
    const bool ends = std::strcmp(file.data() + at, "end") == 0;
    if (ends) {
      put_number(file, at + 24, sums.size());
      file.replace(from, std::string::npos, sums);
    } else {
      put_number(file, at + 24, stored);
    }
    const std::size_t size = ends ? sums.size() : stored;
    const std::uint64_t sum =
        XXH3_64bits((file.substr(at, kHeader) + file.substr(from, size)).data(), kHeader + size);
    put_number(file, at + kHeader, sum);
    sums.append(file, at + kHeader, kSum);
    at = from + size;
  }
}

std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  return line;
}

std::uint32_t next_number(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

Bytes bytes_of(std::string_view line, bool hexadecimal) {
  Bytes bytes;
  for (std::size_t i = 0; i < line.size(); i += hexadecimal ? 2 : 1) {
    unsigned value = static_cast<unsigned char>(line[i]);
    if (hexadecimal) {
      value = 0;
      std::from_chars(line.data() + i, line.data() + std::min(i + 2, line.size()), value, 16);
    }
    bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

std::filesystem::path packed_text(std::string_view text) {
  const std::filesystem::path place = fuzz::folder() / "c.vxc";
  checkpoint::BlockWriter writer(place);
  while (!text.empty()) {
    std::string_view line = next_line(text);
    checkpoint::BlockName name;
    name.kind = line.substr(0, line.find(' '));
    line.remove_prefix(name.kind.size());
    name.first = next_number(line);
    name.count = next_number(line);
    writer.put(name, checkpoint::packed(bytes_of(next_line(text), name.kind != "head")));
  }
  writer.finish();
  return place;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = fuzz::text_of(data, size);
  std::filesystem::path file;
  if (input.starts_with("head ")) {
    file = packed_text(input);
  } else {
    std::string sealed(input);
    make_checksums_fit(sealed);
    file = fuzz::write("c.vxc", sealed);
  }
  fuzz::try_to([&] {
    try {
      checkpoint::Checkpoint whole = checkpoint::read(file);
      const std::string command = whole.head.command;
      run::scene_of(std::move(whole), file);
      app::run_record_of(command, file);
    } catch (const checkpoint::Error& error) {
      fuzz::check_message(error.what());
    } catch (const std::bad_alloc&) {  // a large grid of zeros is a checkpoint, and needs memory
    }
  });
  return 0;
}
