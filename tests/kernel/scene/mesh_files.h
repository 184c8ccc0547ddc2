// Writes the same mesh in each format. Each writer goes by the page of its format alone.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/kernel/scene/mesh_text.h"

namespace voxmelt::scene {

template <class T>
void put(std::string& bytes, T number, bool big_endian = false) {
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(number);  // the tests run on little endians
  if (big_endian)
    bytes.append(raw.rbegin(), raw.rend());
  else
    bytes.append(raw.begin(), raw.end());
}

// Makes fans of the faces, and floats of the coordinates. From -O2 on, g++ 12 forgets to round a pair of
// doubles to float and back, unless the floats are volatile.
inline MeshText as_triangles(const MeshText& mesh) {
  MeshText result = {mesh.vertices, {}};
  for (Corner& vertex : result.vertices)
    for (double& v : vertex) {
      const volatile auto rounded = static_cast<float>(v);
      v = rounded;
    }
  for (const auto& face : mesh.faces)
    for (std::size_t i = 2; i < face.size(); ++i) result.faces.push_back({face[0], face[i - 1], face[i]});
  return result;
}

inline MeshText without_unused(const MeshText& mesh) {
  MeshText result;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (auto face : mesh.faces) {
    for (int& corner : face) {
      int& known = number[static_cast<std::size_t>(corner)];
      if (known < 0) {
        known = static_cast<int>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
      }
      corner = known;
    }
    result.faces.push_back(face);
  }
  return result;
}

inline std::string stl_text(const MeshText& mesh) {
  std::string text = "solid a body\n";
  for (const auto& face : mesh.faces) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int corner : face) {
      const Corner& c = mesh.vertices[static_cast<std::size_t>(corner)];
      text += fmt::format("   vertex {} {} {}\n", c[0], c[1], c[2]);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid a body\n";
}

inline std::string stl_bytes(const MeshText& mesh) {
  std::string bytes = "solid, as many of these headers begin";
  bytes.resize(80);
  put(bytes, static_cast<std::uint32_t>(mesh.faces.size()));
  for (const auto& face : mesh.faces) {
    bytes.append(12, '\0');  // normal
    for (const int corner : face)
      for (const double v : mesh.vertices[static_cast<std::size_t>(corner)])
        put(bytes, static_cast<float>(v));
    bytes.append(2, '\7');  // attributes
  }
  return bytes;
}

// The vertices have a colour, and the faces a list, which are passed over. So is an element of its own.
inline std::string ply_head(const MeshText& mesh, const std::string& format) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment a body\nelement vertex {}\nproperty uchar red\nproperty double x\n"
      "property double y\nproperty double z\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n"
      "element face {}\nproperty list uint8 float32 texture\nproperty list uint int32 vertex_indices\n"
      "property short flags\nend_header\n",
      format, mesh.vertices.size(), mesh.faces.size());
}

inline std::string ply_text(const MeshText& mesh) {
  std::string text = ply_head(mesh, "ascii");
  for (const Corner& c : mesh.vertices) text += fmt::format("255 {} {} {}\n", c[0], c[1], c[2]);
  text += "0 1\n";
  for (const auto& face : mesh.faces) {
    text += fmt::format("2 0.5 1e-3 {}", face.size());
    for (const int corner : face) text += fmt::format(" {}", corner);
    text += " -5\n";
  }
  return text;
}

inline std::string ply_bytes(const MeshText& mesh, bool big) {
  std::string bytes = ply_head(mesh, big ? "binary_big_endian" : "binary_little_endian");
  for (const Corner& c : mesh.vertices) {
    bytes += '\xff';
    for (const double v : c) put(bytes, v, big);
  }
  bytes.append(8, '\1');
  for (const auto& face : mesh.faces) {
    bytes += '\2';
    bytes.append(8, '\x7f');
    put(bytes, static_cast<std::uint32_t>(face.size()), big);
    for (const int corner : face) put(bytes, corner, big);
    put(bytes, std::int16_t{-5}, big);
  }
  return bytes;
}

// The bytes of a mesh of triangles: its indices, and then its coordinates with 4 bytes behind each three.
struct GltfText {
  std::string json, bytes;
};

inline GltfText gltf_text(const MeshText& mesh, const std::string& uri) {
  GltfText result;
  for (const auto& face : mesh.faces)
    for (const int corner : face) put(result.bytes, static_cast<std::uint32_t>(corner));
  const std::size_t indices = result.bytes.size();
  for (const Corner& c : mesh.vertices) {
    for (const double v : c) put(result.bytes, static_cast<float>(v));
    put(result.bytes, 0.0f);
  }
  result.json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"name":"a body"}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":1}},"indices":0}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5125,"count":{0},"type":"SCALAR"}},)"
      R"({{"bufferView":1,"componentType":5126,"count":{1},"type":"VEC3"}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{2}}},{{"buffer":0,"byteOffset":{2},"byteLength":{3},"byteStride":16}}],)"
      R"("buffers":[{{"byteLength":{4}{5}}}]}})",
      3 * mesh.faces.size(), mesh.vertices.size(), indices, result.bytes.size() - indices,
      result.bytes.size(), uri.empty() ? "" : fmt::format(R"(,"uri":"{}")", uri));
  return result;
}

inline std::string glb_bytes(const GltfText& text) {
  std::string json = text.json;
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string bytes = "glTF";
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + text.bytes.size()));
  put(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  put(bytes, static_cast<std::uint32_t>(text.bytes.size()));
  bytes += std::string("BIN\0", 4) + text.bytes;
  return bytes;
}

}  // namespace voxmelt::scene
