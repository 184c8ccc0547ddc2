// Makes OBJ meshes of boxes and balls, and counts plainly the cells that the same bodies fill.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace voxmelt::scene {

using Corner = std::array<double, 3>;

struct MeshText {
  std::vector<Corner> vertices;
  std::vector<std::vector<int>> faces;  // counted from 0

  MeshText& box(Corner low, Corner size) {
    const int first = static_cast<int>(vertices.size());
    for (int i = 0; i < 8; ++i)
      vertices.push_back(
          {low[0] + size[0] * (i & 1), low[1] + size[1] * (i >> 1 & 1), low[2] + size[2] * (i >> 2)});
    for (const auto& face :
         {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
      faces.push_back({first + face[0], first + face[1], first + face[2], first + face[3]});
    return *this;
  }

  // Adds rings of corners between two poles.
  static constexpr int rings = 32, around = 64, ball_faces = rings * around;
  MeshText& ball(Corner at, double radius) {
    const int first = static_cast<int>(vertices.size());
    for (int i = 1; i < rings; ++i)
      for (int k = 0; k < around; ++k) {
        const double down = std::numbers::pi * i / rings, turn = 2 * std::numbers::pi * k / around;
        vertices.push_back({at[0] + radius * std::sin(down) * std::cos(turn), at[1] + radius * std::cos(down),
                            at[2] + radius * std::sin(down) * std::sin(turn)});
      }
    vertices.push_back({at[0], at[1] + radius, at[2]});
    vertices.push_back({at[0], at[1] - radius, at[2]});
    const int top = first + (rings - 1) * around;
    const auto corner = [&](int ring, int k) { return first + ring * around + k % around; };
    for (int k = 0; k < around; ++k) {
      faces.push_back({top, corner(0, k + 1), corner(0, k)});
      faces.push_back({top + 1, corner(rings - 2, k), corner(rings - 2, k + 1)});
      for (int i = 0; i + 2 < rings; ++i)
        faces.push_back({corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)});
    }
    return *this;
  }

  // Adds a prism between y = 0 and `height` over corners (x, z). They run counterclockwise seen from above
  // (+x to -z).
  MeshText& prism(const std::vector<std::array<double, 2>>& outline, double height) {
    const int first = static_cast<int>(vertices.size()), n = static_cast<int>(outline.size());
    for (const double y : {0.0, height})
      for (const auto& [x, z] : outline) vertices.push_back({x, y, z});
    std::vector<int> bottom, top;
    for (int i = 0; i < n; ++i) {
      bottom.push_back(first + n - 1 - i);
      top.push_back(first + n + i);
      faces.push_back({first + i, first + (i + 1) % n, first + n + (i + 1) % n, first + n + i});
    }
    faces.push_back(bottom);
    faces.push_back(top);
    return *this;
  }

  MeshText& turn(std::size_t face) {
    std::reverse(faces[face].begin(), faces[face].end());
    return *this;
  }
  MeshText& turn_from(std::size_t first) {
    for (std::size_t i = first; i < faces.size(); ++i) turn(i);
    return *this;
  }

  // Prints the mesh after `place` has moved its corners.
  std::string text(const std::function<Corner(Corner)>& place = [](Corner c) { return c; }) const {
    std::string text;
    for (const Corner& vertex : vertices) {
      const Corner c = place(vertex);
      text += fmt::format("v {} {} {}\n", c[0], c[1], c[2]);
    }
    for (const auto& face : faces) {
      text += "f";
      for (const int corner : face) text += fmt::format(" {}", corner + 1);
      text += "\n";
    }
    return text;
  }

  std::pair<Corner, Corner> bounds() const {
    Corner low = vertices[static_cast<std::size_t>(faces[0][0])], high = low;
    for (const auto& face : faces)
      for (const int corner : face)
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], vertices[static_cast<std::size_t>(corner)][i]);
          high[i] = std::max(high[i], vertices[static_cast<std::size_t>(corner)][i]);
        }
    return {low, high};
  }
};

using Body = std::function<bool(double x, double y, double z)>;

inline Body box_body(Corner low, Corner size) {
  return [=](double x, double y, double z) {
    return x > low[0] && x < low[0] + size[0] && y > low[1] && y < low[1] + size[1] && z > low[2] &&
           z < low[2] + size[2];
  };
}

inline Body ball_body(Corner at, double radius) {
  return [=](double x, double y, double z) { return std::hypot(x - at[0], y - at[1], z - at[2]) < radius; };
}

inline Body operator|(const Body& a, const Body& b) {
  return [=](double x, double y, double z) { return a(x, y, z) || b(x, y, z); };
}

inline Body operator-(const Body& a, const Body& b) {
  return [=](double x, double y, double z) { return a(x, y, z) && !b(x, y, z); };
}

}  // namespace voxmelt::scene
