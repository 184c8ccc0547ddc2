#include "kernel/run/io/npz.h"

#include <libdeflate.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/run/io/columns.h"
#include "kernel/run/io/file_writer.h"

namespace voxmelt::io {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();

void append(std::string& bytes, std::uint64_t number, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(number >> (8 * i));
}

// Returns what the two headers of a member have in common. It takes version 2.0 to read it, and it is not
// packed. The time is the first day of MS-DOS, so that equal states have equal files.
std::string common_of(const std::string& name, std::uint32_t crc, std::uint64_t size) {
  std::string bytes;
  append(bytes, 20, 2);
  append(bytes, 0, 2 + 2 + 2);  // flags, method, time
  append(bytes, 0x21, 2);
  append(bytes, crc, 4);
  append(bytes, size, 4);
  append(bytes, size, 4);
  append(bytes, name.size(), 2);
  append(bytes, 0, 2);  // no extra field
  return bytes;
}

struct Archive {
  FileWriter& file;
  std::uint64_t at = 0;     // bytes written
  std::string directory{};  // central directory, up to now
  std::size_t members = 0;

  void write(std::string_view bytes) {
    file.write(bytes);
    at += bytes.size();
  }
  void add(const Column& column, state::Grid g, const Poll& poll) {
    const std::string name = column.name + ".npy", header = npy_header(column, g);
    std::uint32_t crc = libdeflate_crc32(0, header.data(), header.size());
    for_each_piece(column, g, poll,
                   [&](std::string_view rows) { crc = libdeflate_crc32(crc, rows.data(), rows.size()); });
    const std::string common = common_of(name, crc, header.size() + g.cells() * column.bytes);
    directory += "PK\x01\x02";
    append(directory, 20, 2);
    directory += common;
    append(directory, 0, 2 + 2 + 2 + 4);  // no comment, disk 0, no attributes
    append(directory, at, 4);
    directory += name;
    write("PK\x03\x04" + common + name + header);
    for_each_piece(column, g, poll, [&](std::string_view rows) { write(rows); });
    ++members;
  }
  void end() {
    std::string last = "PK\x05\x06";
    append(last, 0, 2 + 2);  // disk 0
    append(last, members, 2);
    append(last, members, 2);
    append(last, directory.size(), 4);
    append(last, at, 4);
    append(last, 0, 2);  // no comment
    write(directory + last);
  }
};

}  // namespace

void export_npz(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const state::Grid g = moment.volume.grid;
  const std::vector<Column> columns = columns_of(moment.volume);
  const std::filesystem::path place = folder / "fields.npz";
  std::uint64_t size = 0;
  for (const Column& column : columns) size += g.cells() * column.bytes + 1024;
  if (size > kMost)
    fail_output(place, "npz holds 4 GiB, and these fields take more; npy has a file for each", EFBIG);
  FileWriter file(place);
  Archive archive{file};
  for (const Column& column : columns) archive.add(column, g, poll);
  archive.end();
  file.commit();
}

}  // namespace voxmelt::io
