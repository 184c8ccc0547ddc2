#include "kernel/run/io/export.h"

#include <cstddef>
#include <cstdint>
#include <functional>

#include "kernel/run/io/output_folder.h"

namespace voxmelt::io {
namespace {

std::string bytes_of(const state::Field<std::uint16_t>& field, state::Grid g) {
  std::string bytes;
  bytes.reserve(g.cells() * sizeof(std::uint16_t));
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      bytes.append(reinterpret_cast<const char*>(field.row(y, z)),
                   static_cast<std::size_t>(g.x) * sizeof(std::uint16_t));
  return bytes;
}

std::string unpacked(const state::BitPlane& plane, state::Grid g) {
  std::string bytes;
  bytes.reserve(g.cells());
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) bytes += static_cast<char>(plane.test(x, y, z));
  return bytes;
}

struct Field {
  const char* name;
  const char* npy_type;
  const char* vtk_type;
  std::string bytes;
};

// Each field is written in turn, so that only one copy exists at a time.
void for_each_field(const state::Volume& v, const std::function<void(const Field&)>& visit) {
  visit({"solid", "|u1", "UInt8", unpacked(v.solid, v.grid)});
  visit({"liquid", "|u1", "UInt8", unpacked(v.liquid, v.grid)});
  visit({"inert", "|u1", "UInt8", unpacked(v.inert, v.grid)});
  visit({"amount", "<u2", "UInt16", bytes_of(v.amount, v.grid)});
  visit({"energy", "<u2", "UInt16", bytes_of(v.energy, v.grid)});
  visit({"heat", "<u2", "UInt16", bytes_of(v.heat, v.grid)});
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

}  // namespace

void export_npy(const state::Volume& volume, const std::filesystem::path& folder) {
  for_each_field(volume, [&](const Field& field) {
    write_file(folder / (std::string(field.name) + ".npy"),
               npy_header(field.npy_type, volume.grid) + field.bytes);
  });
}

void export_vti(const state::Volume& volume, const std::filesystem::path& folder) {
  const state::Grid g = volume.grid;
  const std::string extent =
      "0 " + std::to_string(g.x) + " 0 " + std::to_string(g.y) + " 0 " + std::to_string(g.z);
  std::string arrays, data;
  for_each_field(volume, [&](const Field& field) {
    arrays += std::string("        <DataArray type=\"") + field.vtk_type + "\" Name=\"" + field.name +
              "\" format=\"appended\" offset=\"" + std::to_string(data.size()) + "\"/>\n";
    const std::uint64_t size = field.bytes.size();
    data.append(reinterpret_cast<const char*>(&size), sizeof size);
    data += field.bytes;
  });
  write_file(
      folder / "volume.vti",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n  <ImageData WholeExtent=\"" +
          extent + "\" Origin=\"0 0 0\" Spacing=\"1 1 1\">\n    <Piece Extent=\"" + extent +
          "\">\n      <CellData Scalars=\"amount\">\n" + arrays +
          "      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_" + data +
          "\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace voxmelt::io
