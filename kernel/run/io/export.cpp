#include "kernel/run/io/export.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/run/io/columns.h"
#include "kernel/run/io/csv.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/npz.h"
#include "kernel/run/io/surface_files.h"

namespace voxmelt::io {
namespace {

void write_rows(FileWriter& file, const Column& column, state::Grid g, const Poll& poll) {
  for_each_piece(column, g, poll, [&](std::string_view rows) { file.write(rows); });
}

// Writes all fields as cell data of one VTK image: volume.vti (raw appended, little endian).
void export_vti(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const state::Volume& volume = moment.volume;
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
void export_nrrd(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const state::Volume& volume = moment.volume;
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

void export_arrays(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  export_npy(moment.volume, folder, poll);
}

constexpr std::array kFormats{
    Format{"npy", "NumPy arrays (z, y, x)", export_arrays},
    Format{"vti", "one VTK image", export_vti},
    Format{"nrrd", "NRRD, for teem and 3D Slicer", export_nrrd},
    Format{"npz", "NumPy arrays in one file", export_npz},
    Format{"ply", "the surface, with heat and material", export_ply},
    Format{"glb", "the same for viewers", export_glb},
    Format{"stl", "the surface alone", export_stl},
    Format{"obj", "the same as text", export_obj},
    Format{"csv", "a row of the books", export_csv},
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
    file.write(npy_header(column, volume.grid));
    write_rows(file, column, volume.grid, poll);
    file.commit();
  }
}

}  // namespace voxmelt::io
