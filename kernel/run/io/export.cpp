#include "kernel/run/io/export.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "kernel/automaton/state/fields.h"
#include "kernel/run/io/file_writer.h"

namespace voxmelt::io {
namespace {

// Tells the name of a field in the files, and writes one row of it.
struct Column {
  std::string name;
  const char* npy_type;
  const char* vtk_type;
  std::size_t bytes;  // bytes of a cell
  std::function<void(std::string& rows, int y, int z)> append_row;
};

void append_row(std::string& rows, const state::BitPlane& plane, int y, int z, std::size_t width) {
  const std::size_t first = rows.size();
  rows.resize(first + width);
  const auto words = plane.row(y, z);
  for (std::size_t w = 0; w < words.size(); ++w)
    for (std::uint64_t left = words[w]; left != 0; left &= left - 1)
      rows[first + 64 * w + std::countr_zero(left)] = 1;
}
template <class T>
void append_row(std::string& rows, const state::Field<T>& field, int y, int z, std::size_t width) {
  rows.append(reinterpret_cast<const char*>(field.row(y, z)), width * sizeof(T));
}

// Returns the columns of a volume. Masks have a byte for each cell.
std::vector<Column> columns_of(const state::Volume& volume) {
  const std::size_t width = volume.grid.x;
  std::vector<Column> columns;
  state::for_each_field([&](const auto& row) {
    const auto& cells = volume.*row.column;
    if (cells.empty()) return;
    const bool wide = row.bits > 8;
    columns.push_back(
        {std::string(row.name), wide ? "<u2" : "|u1", wide ? "UInt16" : "UInt8",
         wide ? std::size_t{2} : std::size_t{1},
         [&cells, width](std::string& rows, int y, int z) { append_row(rows, cells, y, z, width); }});
  });
  return columns;
}

// Writes some rows at a time, so that an export takes no memory to speak of beside the state.
void write_rows(FileWriter& file, const Column& column, state::Grid g, const Poll& poll) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::string rows;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      column.append_row(rows, y, z);
      if (rows.size() < piece) continue;
      file.write(rows);
      rows.clear();
      if (poll) poll();
    }
  file.write(rows);
}

std::string npy_header(const char* type, state::Grid g) {
  std::string text = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (" +
                     std::to_string(g.z) + ", " + std::to_string(g.y) + ", " + std::to_string(g.x) + "), }";
  constexpr std::size_t preamble = 10;  // magic, version, header length
  text.append(63 - (preamble + text.size()) % 64, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(text.size() & 0xFF);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

// Writes all fields as cell data of one VTK image: volume.vti (raw appended, little endian).
void export_vti(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll) {
  const state::Grid g = volume.grid;
  const std::string extent =
      "0 " + std::to_string(g.x) + " 0 " + std::to_string(g.y) + " 0 " + std::to_string(g.z);
  const std::vector<Column> columns = columns_of(volume);
  std::string arrays;
  std::uint64_t offset = 0;
  for (const Column& column : columns) {
    arrays += std::string("        <DataArray type=\"") + column.vtk_type + "\" Name=\"" + column.name +
              "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += sizeof offset + g.cells() * column.bytes;
  }
  FileWriter file(folder / "volume.vti");
  file.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n  <ImageData WholeExtent=\"" +
      extent + "\" Origin=\"0 0 0\" Spacing=\"1 1 1\">\n    <Piece Extent=\"" + extent +
      "\">\n      <CellData Scalars=\"amount\">\n" + arrays +
      "      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_");
  for (const Column& column : columns) {
    const std::uint64_t size = g.cells() * column.bytes;
    file.write({reinterpret_cast<const char*>(&size), sizeof size});
    write_rows(file, column, g, poll);
  }
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

// Writes FIELD.nrrd, as it is in memory. NRRD names the fastest axis first.
void export_nrrd(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll) {
  const state::Grid g = volume.grid;
  for (const Column& column : columns_of(volume)) {
    FileWriter file(folder / (column.name + ".nrrd"));
    file.write("NRRD0004\ncontent: " + column.name + "\ntype: " + (column.bytes == 1 ? "uint8" : "uint16") +
               "\ndimension: 3\nsizes: " + std::to_string(g.x) + " " + std::to_string(g.y) + " " +
               std::to_string(g.z) + "\nspacings: 1 1 1\nlabels: \"x\" \"y\" \"z\"\n" +
               "endian: little\nencoding: raw\n\n");
    write_rows(file, column, g, poll);
    file.commit();
  }
}

constexpr std::array kFormats{
    Format{"npy", "NumPy arrays (z, y, x)", export_npy},
    Format{"vti", "one VTK image", export_vti},
    Format{"nrrd", "NRRD, for teem and 3D Slicer", export_nrrd},
};

}  // namespace

std::span<const Format> formats() { return kFormats; }

const Format* find_format(std::string_view name) {
  const auto found = std::ranges::find(kFormats, name, &Format::name);
  return found != kFormats.end() ? &*found : nullptr;
}

void export_npy(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll) {
  for (const Column& column : columns_of(volume)) {
    FileWriter file(folder / (column.name + ".npy"));
    file.write(npy_header(column.npy_type, volume.grid));
    write_rows(file, column, volume.grid, poll);
    file.commit();
  }
}

}  // namespace voxmelt::io
