#include "kernel/run/io/export.h"

#include <algorithm>
#include <array>
#include <string>

#include "kernel/run/io/columns.h"
#include "kernel/run/io/csv.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/npz.h"
#include "kernel/run/io/surface_files.h"
#include "kernel/run/io/vdb.h"
#include "kernel/run/io/vti.h"

namespace voxmelt::io {
namespace {

void write_rows(FileWriter& file, const Column& column, state::Grid g, const Poll& poll) {
  for_each_piece(column, g, poll, [&](std::string_view rows) { file.write(rows); });
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
    Format{"vdb", "OpenVDB, for Blender and Houdini", export_vdb, false, missing_for_vdb},
    Format{"npz", "NumPy arrays in one file", export_npz},
    Format{"ply", "the surface, with heat and material", export_ply, true},
    Format{"glb", "the same for viewers", export_glb, true},
    Format{"stl", "the surface alone", export_stl, true},
    Format{"obj", "the same as text", export_obj, true},
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
