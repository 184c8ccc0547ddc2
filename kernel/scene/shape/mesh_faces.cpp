#include "kernel/scene/shape/mesh_faces.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

namespace voxmelt::scene {
namespace {

// Reads a face from its least corner on, in the direction in which the lesser neighbour comes first.
struct Canonical {
  std::span<const std::uint32_t> corners;
  std::size_t first = 0;
  bool forward = true;

  explicit Canonical(std::span<const std::uint32_t> face) : corners(face) {
    first = std::min_element(face.begin(), face.end()) - face.begin();
    const std::size_t n = face.size();
    forward = face[(first + 1) % n] <= face[(first + n - 1) % n];
  }
  std::uint32_t operator[](std::size_t i) const {
    const std::size_t n = corners.size();
    return corners[(forward ? first + i : first + n - i) % n];
  }
  std::uint64_t hash() const {
    std::uint64_t hash = corners.size();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      hash = (hash ^ (*this)[i]) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
  friend bool operator==(const Canonical& a, const Canonical& b) {
    if (a.corners.size() != b.corners.size()) return false;
    for (std::size_t i = 0; i < a.corners.size(); ++i)
      if (a[i] != b[i]) return false;
    return true;
  }
};

// Returns, for each vertex, the number of its place. `places` gets one vertex of each place that a face uses.
std::vector<std::uint32_t> weld(const Mesh& mesh, std::vector<Point>& places) {
  std::vector<bool> used(mesh.vertices.size());
  for (const std::uint32_t corner : mesh.corners) used[corner] = true;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < used.size(); ++i)
    if (used[i]) order.push_back(i);
  const auto key = [&](std::uint32_t i) {
    const Point& p = mesh.vertices[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<std::uint32_t> number(mesh.vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || key(order[i - 1]) != key(order[i])) places.push_back(mesh.vertices[order[i]]);
    number[order[i]] = static_cast<std::uint32_t>(places.size() - 1);
  }
  return number;
}

bool is_flat(const std::vector<Point>& vertices, std::span<const std::uint32_t> face) {
  double longest = 0, area = 0;
  const Point origin = vertices[face[0]];
  for (std::size_t i = 1; i < face.size(); ++i) {
    const Point u = vertices[face[i]] - origin, v = vertices[face[i - 1]] - origin;
    longest = std::max(longest, dot(u, u));
    area = std::max(area, length({u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x}));
  }
  return area <= 1e-9 * longest;
}

void append(Mesh& mesh, std::span<const std::uint32_t> face) {
  mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
  mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
}

template <class Keep>
void keep_faces(Mesh& mesh, Keep keep) {
  Mesh kept;
  for (std::size_t f = 0; f < mesh.faces(); ++f)
    if (keep(f)) append(kept, mesh.face(f));
  mesh.corners = std::move(kept.corners);
  mesh.ends = std::move(kept.ends);
}

// Keeps the first one of faces with the same corners. It returns which of those are there in both senses.
std::vector<bool> drop_copies(Mesh& mesh) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(mesh.faces());
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) order[f] = {Canonical(mesh.face(f)).hash(), f};
  std::sort(order.begin(), order.end());
  std::vector<bool> dropped(mesh.faces()), both(mesh.faces()), result;
  for (std::size_t i = 0; i < order.size();) {
    const std::uint32_t first = order[i].second;
    const Canonical original(mesh.face(first));
    const std::uint64_t hash = order[i].first;
    for (++i; i < order.size() && order[i].first == hash; ++i) {
      const Canonical other(mesh.face(order[i].second));
      if (!(other == original)) continue;
      dropped[order[i].second] = true;
      if (other.forward != original.forward) both[first] = true;
    }
  }
  for (std::size_t f = 0; f < mesh.faces(); ++f)
    if (!dropped[f]) result.push_back(both[f]);
  keep_faces(mesh, [&](std::size_t f) { return !dropped[f]; });
  return result;
}

// Drops walls. Faces in both senses are either a skin written from both sides, of which one side remains, or
// a wall between two bodies that touch, which is dropped. Connected ones are judged together. They are a wall
// if an even number of other faces meets them at most edges. These faces close the surface without the wall.
void drop_walls(Mesh& mesh, const std::vector<bool>& both) {
  const std::vector<Edge> edges = edges_of(mesh);
  Sets skins(mesh.faces());
  const auto in_both = [&](const Edge& edge) { return both[edge.face]; };
  for_each_edge(edges, [&](auto first, auto last) {
    const auto one = std::find_if(first, last, in_both);
    for (auto edge = first; edge != last; ++edge)
      if (in_both(*edge)) skins.unite(one->face, edge->face);
  });
  std::vector<std::int64_t> wall(mesh.faces());
  for_each_edge(edges, [&](auto first, auto last) {
    const auto doubles = std::count_if(first, last, in_both), others = last - first - doubles;
    if (doubles > 0 && others > 0)
      wall[skins.find(std::find_if(first, last, in_both)->face)] += others % 2 == 0 ? 1 : -1;
  });
  keep_faces(mesh,
             [&](std::size_t f) { return !both[f] || wall[skins.find(static_cast<std::uint32_t>(f))] <= 0; });
}

}  // namespace

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(mesh.corners.size());
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint64_t a = face[i], b = face[i + 1 < face.size() ? i + 1 : 0];
      edges.push_back({std::min(a, b) << 32 | std::max(a, b), f, static_cast<std::int8_t>(a < b ? 1 : -1)});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

Sets::Sets(std::size_t count) : links_(count) {
  for (std::uint32_t i = 0; i < count; ++i) links_[i] = {i, false};
}

Sets::Link Sets::look(std::uint32_t member) {
  Link way{member, false};
  while (links_[way.root].root != way.root)
    way = {links_[way.root].root, way.turned != links_[way.root].turned};
  // The way is shortened for later callers.
  for (Link rest = way; links_[member].root != way.root && member != way.root;) {
    const Link next = links_[member];
    links_[member] = rest;
    rest.turned = rest.turned != next.turned;
    member = next.root;
  }
  return way;
}

void Sets::unite(std::uint32_t a, std::uint32_t b, bool turned) {
  const Link of_a = look(a), of_b = look(b);
  if (of_a.root == of_b.root) return;
  const auto [low, high] = std::minmax(of_a.root, of_b.root);
  links_[high] = {low, (of_a.turned != of_b.turned) != turned};
}

CleanMesh clean(const Mesh& mesh) {
  CleanMesh result;
  const std::vector<std::uint32_t> number = weld(mesh, result.mesh.vertices);
  std::vector<bool> used(mesh.vertices.size());
  for (const std::uint32_t corner : mesh.corners) used[corner] = true;
  result.unused = std::count(used.begin(), used.end(), false);

  std::vector<std::uint32_t> ring;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    ring.clear();
    for (const std::uint32_t corner : mesh.face(f))
      if (ring.empty() || ring.back() != number[corner]) ring.push_back(number[corner]);
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() < 3 || is_flat(result.mesh.vertices, ring)) ++result.flat;
    if (ring.size() >= 3) append(result.mesh, ring);
  }
  const std::size_t before = result.mesh.faces();
  const std::vector<bool> both = drop_copies(result.mesh);
  result.doubled = before - result.mesh.faces();
  if (std::find(both.begin(), both.end(), true) != both.end()) drop_walls(result.mesh, both);
  return result;
}

}  // namespace voxmelt::scene
