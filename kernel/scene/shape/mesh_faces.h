// The shells of a mesh need clean faces: vertices at one place are one, and no face is there twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/scene/shape/mesh.h"

namespace voxmelt::scene {

// Is a side of a face, between two vertices that are neighbours in it.
struct Edge {
  std::uint64_t key = 0;   // the same for all faces at this edge
  std::uint32_t face = 0;  // its number
  std::int8_t sense = 1;   // 1: the face runs from the lower vertex to the higher one; else -1

  friend bool operator<(const Edge& a, const Edge& b) { return a.key < b.key; }
};

// Returns all edges, sorted by key. A face that runs along an edge and back has two of them there.
std::vector<Edge> edges_of(const Mesh& mesh);

// Calls visit(first, last) for each range of equal keys.
template <class Visit>
void for_each_edge(const std::vector<Edge>& edges, Visit visit) {
  for (auto first = edges.begin(); first != edges.end();) {
    auto last = first;
    while (last != edges.end() && last->key == first->key) ++last;
    visit(first, last);
    first = last;
  }
}

// Holds sets of numbers that grow together.
class Sets {
 public:
  explicit Sets(std::size_t count);
  std::uint32_t find(std::uint32_t member) { return look(member).root; }
  // Tells if the two are turned against one another. Both must be in one set.
  bool turned(std::uint32_t member) { return look(member).turned; }
  // Puts two sets together such that a and b are turned against one another, or not. It has no effect within
  // a set.
  void unite(std::uint32_t a, std::uint32_t b, bool turned = false);

 private:
  struct Link {
    std::uint32_t root;
    bool turned;
  };
  Link look(std::uint32_t member);

  std::vector<Link> links_;
};

struct CleanMesh {
  Mesh mesh;                                      // vertices differ, all of them are used
  std::size_t doubled = 0, flat = 0, unused = 0;  // faces left out, faces without area, vertices unused
};

CleanMesh clean(const Mesh& mesh);

}  // namespace voxmelt::scene
