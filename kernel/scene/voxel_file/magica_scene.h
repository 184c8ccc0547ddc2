// The scene of a MagicaVoxel file says where its models stand, and how they are turned.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "kernel/scene/voxel_file/voxels.h"

namespace voxmelt::scene {

using Place3 = std::array<std::int64_t, 3>;  // x, y, z of the file, where z points up

// A rotation by quarter turns, which may mirror, and then a move: row r of the result is `sign[r]` times the
// coordinate `from[r]`, plus `move[r]`.
struct Turn {
  std::array<std::size_t, 3> from{0, 1, 2};
  std::array<int, 3> sign{1, 1, 1};
  Place3 move{};

  Place3 of(const Place3& place) const;  // without the move
  Turn after(const Turn& first) const;   // what both do, `first` first
};

// A model that is seen.
struct PlacedModel {
  std::size_t model = 0;
  Turn turn;
};

// Collects the nodes of a scene from their chunks, in whatever order these come.
class MagicaScene {
 public:
  explicit MagicaScene(const VoxelSource& source) : source_(source) {}

  // Reads the chunk if it is one of the scene. Anything else is passed over.
  void read(std::string_view name, std::string_view content);

  bool is_there() const { return !nodes_.empty(); }
  // Returns the models that are seen, by the first frame of each animation. It fails if the nodes are no
  // tree.
  std::vector<PlacedModel> models(std::size_t count) const;

 private:
  using Id = std::int32_t;
  struct Node {
    bool is_hidden = false;
    Id layer = -1;
    Turn turn;
    std::vector<Id> children;
    std::vector<Id> models;  // of a shape
  };
  struct Step {  // of the walk
    Id node = 0;
    Turn turn;
  };

  VoxelSource source_;
  std::map<Id, Node> nodes_;
  std::set<Id> hidden_layers_;
};

}  // namespace voxmelt::scene
