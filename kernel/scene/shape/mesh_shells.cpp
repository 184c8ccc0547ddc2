#include "kernel/scene/shape/mesh_shells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "kernel/scene/shape/mesh_cavities.h"
#include "kernel/scene/shape/mesh_faces.h"

namespace voxmelt::scene {
namespace {

// Halves a polygon again and again. If it is not convex, some triangles lie outside and are turned, so that
// rays count nothing there. So no corner must be cut off with care.
template <class Visit>
void for_each_triangle(std::span<const std::uint32_t> ring, Visit visit) {
  if (ring.size() < 3) return;
  const std::size_t middle = (ring.size() - 1) / 2;
  visit(ring.front(), ring[middle], ring.back());
  for_each_triangle(ring.first(middle + 1), visit);
  for_each_triangle(ring.subspan(middle), visit);
}

double determinant(Point a, Point b, Point c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

class Shells {
 public:
  explicit Shells(const Mesh& mesh)
      : mesh_(mesh), edges_(edges_of(mesh)), turned_(mesh.faces()), shell_(mesh.faces()) {}

  void build() {
    orient_patches();
    join_patches();
    measure();
  }

  std::size_t flipped() const { return flipped_; }
  std::size_t open_edges() const { return open_edges_; }
  std::size_t crowded_edges() const { return crowded_edges_; }
  const std::vector<double>& volumes() const { return volumes_; }
  double flat_volume(std::size_t shell) const {
    return 1e-9 * std::pow(length(boxes_[shell].high - boxes_[shell].low), 3);
  }
  std::size_t shell_of(std::size_t face) const { return shell_[face]; }

  // Returns the surface. Shells with true in `turn` are turned as a whole.
  Surface surface(const std::vector<bool>& turn) const {
    Surface result;
    for (const Point& p : mesh_.vertices) result.points.push_back({snap(p.x), snap(p.y), snap(p.z)});
    for (std::size_t f = 0; f < mesh_.faces(); ++f) {
      const bool turned = turned_[f] != turn[shell_[f]];
      for_each_triangle(mesh_.face(f), [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        result.triangles.push_back({a, turned ? c : b, turned ? b : c});
      });
    }
    for_each_edge(edges_, [&](auto first, auto last) {
      std::int64_t sum = 0;
      for (auto edge = first; edge != last; ++edge)
        sum += turned_[edge->face] != turn[shell_[edge->face]] ? -edge->sense : edge->sense;
      result.closed = result.closed && sum == 0;
    });
    return result;
  }

 private:
  static std::int64_t snap(double v) {
    constexpr double snaps_per_cell = kMeshUnit / kMeshSnap;
    return std::llround(v * snaps_per_cell) * kMeshSnap;
  }

  // Orients the patches. A patch has faces that are connected where exactly two of them meet. They run
  // through such an edge in opposite directions. If a part of a patch does not, the lesser part is turned.
  void orient_patches() {
    Sets patches(mesh_.faces());
    for_each_edge(edges_, [&](auto first, auto last) {
      if (last - first == 2) patches.unite(first->face, (last - 1)->face, first->sense == (last - 1)->sense);
      open_edges_ += last - first == 1 ? 1 : 0;
      crowded_edges_ += last - first > 2 ? 1 : 0;
    });
    std::vector<std::size_t> faces(mesh_.faces()), turned(mesh_.faces());
    for (std::uint32_t f = 0; f < mesh_.faces(); ++f) {
      shell_[f] = patches.find(f);
      turned_[f] = patches.turned(f);
      ++faces[shell_[f]];
      turned[shell_[f]] += turned_[f] ? 1 : 0;
    }
    for (std::uint32_t f = 0; f < mesh_.faces(); ++f)
      if (2 * turned[shell_[f]] > faces[shell_[f]]) turned_[f] = !turned_[f];
    flipped_ = std::count(turned_.begin(), turned_.end(), true);
  }

  // Joins patches to shells. If more than two faces meet at an edge, patches that are open there close one
  // another, and are one shell.
  void join_patches() {
    Sets shells(mesh_.faces());
    std::vector<std::pair<std::uint32_t, int>> sums;  // each patch with its sum at one edge
    for_each_edge(edges_, [&](auto first, auto last) {
      if (last - first <= 2) return;
      sums.clear();
      for (auto edge = first; edge != last; ++edge)
        sums.emplace_back(shell_[edge->face], turned_[edge->face] ? -edge->sense : edge->sense);
      std::sort(sums.begin(), sums.end());
      std::uint32_t open = 0;
      bool any = false;
      for (std::size_t i = 0; i < sums.size();) {
        const std::uint32_t patch = sums[i].first;
        int sum = 0;
        for (; i < sums.size() && sums[i].first == patch; ++i) sum += sums[i].second;
        if (sum == 0) continue;
        if (any) shells.unite(open, patch);
        open = patch;
        any = true;
      }
    });
    std::vector<std::uint32_t> number(mesh_.faces(), UINT32_MAX);
    std::uint32_t count = 0;
    for (std::uint32_t& shell : shell_) {
      std::uint32_t& n = number[shells.find(shell)];
      if (n == UINT32_MAX) n = count++;
      shell = n;
    }
    volumes_.resize(count);
  }

  // Measures the volumes as seen from the middle of a shell, so that an open one has a sensible volume too.
  void measure() {
    boxes_.resize(volumes_.size(), {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}});
    for (std::size_t f = 0; f < mesh_.faces(); ++f)
      for (const std::uint32_t corner : mesh_.face(f)) boxes_[shell_[f]].include(mesh_.vertices[corner]);
    for (std::size_t f = 0; f < mesh_.faces(); ++f) {
      const Box& box = boxes_[shell_[f]];
      const Point middle = (box.low + box.high) * 0.5;
      for_each_triangle(mesh_.face(f), [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const double sixfold =
            determinant(mesh_.vertices[a] - middle, mesh_.vertices[b] - middle, mesh_.vertices[c] - middle);
        volumes_[shell_[f]] += (turned_[f] ? -sixfold : sixfold) / 6;
      });
    }
  }

  const Mesh& mesh_;
  std::vector<Edge> edges_;
  std::vector<bool> turned_;          // for each face: it is turned against how it is written
  std::vector<std::uint32_t> shell_;  // shell of each face; at first its patch
  std::vector<double> volumes_;       // volume of each shell; negative: it is written inside out
  std::vector<Box> boxes_;
  std::size_t flipped_ = 0, open_edges_ = 0, crowded_edges_ = 0;
};

std::string count_of(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace

Surface surface_of(const Mesh& mesh, std::vector<std::string>& findings) {
  const auto find = [&](std::size_t n, const char* one, const char* many, const char* what) {
    if (n > 0) findings.push_back(count_of(n, one, many) + what);
  };
  find(mesh.short_faces, "face", "faces", " of one or two corners: left out");
  const CleanMesh clean_mesh = clean(mesh);
  Shells shells(clean_mesh.mesh);
  shells.build();

  // If the volumes sum to less than nothing, the whole mesh is written inside out. A shell that points inward
  // after that is a cavity within another shell, or is turned.
  const std::vector<double>& volumes = shells.volumes();
  double sum = 0;
  for (const double volume : volumes) sum += volume;
  std::vector<bool> turn(volumes.size(), sum < 0), inward(volumes.size());
  std::size_t flat = 0;
  for (std::size_t s = 0; s < volumes.size(); ++s) {
    const bool has_volume = std::abs(volumes[s]) > shells.flat_volume(s);
    flat += has_volume ? 0 : 1;
    inward[s] = has_volume && (volumes[s] < 0) != (sum < 0);
  }
  std::size_t cavities = 0, turned = 0;
  if (std::find(inward.begin(), inward.end(), true) != inward.end()) {
    const Surface surface = shells.surface(turn);
    std::vector<std::uint32_t> shell_of_triangle;
    for (std::size_t f = 0; f < clean_mesh.mesh.faces(); ++f)
      shell_of_triangle.insert(shell_of_triangle.end(), clean_mesh.mesh.face(f).size() - 2,
                               static_cast<std::uint32_t>(shells.shell_of(f)));
    const std::vector<bool> cavity = within_others(surface, shell_of_triangle, inward);
    for (std::size_t s = 0; s < volumes.size(); ++s) {
      if (inward[s] && !cavity[s]) turn[s] = !turn[s];
      cavities += cavity[s] ? 1 : 0;
    }
  }
  for (std::size_t s = 0; s < volumes.size(); ++s) turned += turn[s] ? 1 : 0;

  if (volumes.size() > 1)
    findings.push_back(
        fmt::format("{} shells{}", volumes.size(),
                    cavities > 0 ? ", of which " + count_of(cavities, "is a cavity", "are cavities") : ""));
  find(flat, "shell", "shells", " without volume");
  find(turned, "shell", "shells", " inside out: turned");
  find(shells.flipped(), "flipped face", "flipped faces", ": turned");
  find(clean_mesh.doubled, "double face", "double faces", ": counted once");
  find(shells.open_edges(), "open edge", "open edges", ": the mean over six directions says what is inside");
  find(shells.crowded_edges(), "edge", "edges", " of more than two faces");
  find(clean_mesh.flat, "face", "faces", " without area");
  find(clean_mesh.unused, "vertex", "vertices", " without a face");
  return shells.surface(turn);
}

}  // namespace voxmelt::scene
