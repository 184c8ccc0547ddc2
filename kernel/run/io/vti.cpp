#include "kernel/run/io/vti.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/run/io/columns.h"
#include "kernel/run/io/file_writer.h"

namespace voxmelt::io {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // bytes before packing

class Packer {
 public:
  Packer() {
    if (compressor_ == nullptr) throw std::bad_alloc();
  }
  // Returns a zlib stream, which the next call overwrites.
  std::string_view pack(std::string_view bytes) {
    packed_.resize(libdeflate_zlib_compress_bound(compressor_.get(), bytes.size()));
    const std::size_t size = libdeflate_zlib_compress(compressor_.get(), bytes.data(), bytes.size(),
                                                      packed_.data(), packed_.size());
    return {packed_.data(), size};
  }

 private:
  struct Free {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_{libdeflate_alloc_compressor(1)};
  std::string packed_;
};

// Packs the blocks of a column, and gives each to `take`.
void for_each_block(const Column& column, state::Grid g, Packer& packer, const Poll& poll,
                    const std::function<void(std::string_view)>& take) {
  std::string block;
  for_each_piece(column, g, poll, [&](std::string_view rows) {
    while (!rows.empty()) {
      const std::size_t fits = std::min(kBlock - block.size(), rows.size());
      block += rows.substr(0, fits);
      rows.remove_prefix(fits);
      if (block.size() < kBlock) break;
      take(packer.pack(block));
      block.clear();
    }
  });
  if (!block.empty()) take(packer.pack(block));
}

// Holds the sizes of a column's packed blocks, and the blocks themselves while there is room.
struct Packed {
  std::vector<std::uint64_t> sizes;
  std::uint64_t bytes = 0;
  std::string kept;
  bool whole = true;
};

Packed packed_of(const Column& column, state::Grid g, Packer& packer, std::size_t room, const Poll& poll) {
  Packed packed;
  for_each_block(column, g, packer, poll, [&](std::string_view block) {
    packed.sizes.push_back(block.size());
    packed.bytes += block.size();
    packed.whole = packed.whole && packed.bytes <= room;
    if (packed.whole)
      packed.kept += block;
    else
      packed.kept = {};
  });
  return packed;
}

// Returns the header of an array: how many blocks, their size before packing, that of a last one that is
// shorter (else 0), and the size of each when packed.
std::string header_of(const Packed& packed, std::uint64_t bytes) {
  std::vector<std::uint64_t> numbers{packed.sizes.size(), kBlock, bytes % kBlock};
  numbers.insert(numbers.end(), packed.sizes.begin(), packed.sizes.end());
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(std::uint64_t)};
}

// Returns what ParaView shows beside the fields: the time, where they come from, and all that the rules use.
std::string field_data_of(const Moment& moment) {
  std::vector<NamedValue> values{
      {.name = "TimeValue", .type = "Float64", .text = std::to_string(moment.step)}};
  if (!moment.version.empty()) values.push_back(named_word("version", moment.version));
  if (!moment.scene.empty()) values.push_back(named_word("scene", moment.scene));
  if (moment.parameters != nullptr)
    for (NamedValue& value : named_values(*moment.parameters)) values.push_back(std::move(value));
  std::string text;
  for (const NamedValue& value : values) {
    const std::string element = value.type == std::string_view("String") ? "Array" : "DataArray";
    text += "      <" + element + " type=\"" + value.type + "\" Name=\"" + value.name + "\" ";
    if (value.components > 1) text += "NumberOfComponents=\"" + std::to_string(value.components) + "\" ";
    text += "NumberOfTuples=\"" + std::to_string(value.tuples) + "\" format=\"ascii\">" + value.text + "</" +
            element + ">\n";
  }
  return text;
}

// Returns all that stands before the arrays.
std::string head_of(const Moment& moment, const std::string& arrays) {
  const state::Grid g = moment.volume.grid;
  const std::string extent =
      "0 " + std::to_string(g.x) + " 0 " + std::to_string(g.y) + " 0 " + std::to_string(g.z);
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <ImageData WholeExtent=\"" +
         extent + "\" Origin=\"0 0 0\" Spacing=\"1 1 1\">\n    <FieldData>\n" + field_data_of(moment) +
         "    </FieldData>\n    <Piece Extent=\"" + extent + "\">\n      <CellData Scalars=\"amount\">\n" +
         arrays + "      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
}

}  // namespace

void export_vti(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  write_vti(moment, folder, poll, std::size_t{64} << 20);
}

void write_vti(const Moment& moment, const std::filesystem::path& folder, const Poll& poll,
               std::size_t most_kept) {
  const state::Grid g = moment.volume.grid;
  const std::vector<Column> columns = columns_of(moment.volume);
  Packer packer;
  std::vector<Packed> packed;
  std::size_t kept = 0;
  std::string arrays;
  std::uint64_t offset = 0;
  for (const Column& column : columns) {
    packed.push_back(packed_of(column, g, packer, most_kept - kept, poll));
    kept += packed.back().kept.size();
    arrays += std::string("        <DataArray type=\"") + column.vtk_type + "\" Name=\"" + column.name +
              "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += header_of(packed.back(), g.cells() * column.bytes).size() + packed.back().bytes;
  }
  FileWriter file(folder / kVtiFile);
  file.write(head_of(moment, arrays));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    file.write(header_of(packed[i], g.cells() * columns[i].bytes));
    if (packed[i].whole) {
      file.write(packed[i].kept);
      continue;
    }
    std::uint64_t again = 0;
    for_each_block(columns[i], g, packer, poll, [&](std::string_view block) {
      file.write(block);
      again += block.size();
    });
    if (again != packed[i].bytes)
      throw std::logic_error("vti: " + columns[i].name + " packs to " + std::to_string(again) +
                             " bytes, and before to " + std::to_string(packed[i].bytes));
  }
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace voxmelt::io
