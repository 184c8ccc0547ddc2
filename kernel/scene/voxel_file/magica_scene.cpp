#include "kernel/scene/voxel_file/magica_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "kernel/scene/text/bytes.h"
#include "kernel/scene/text/text_file.h"
#include "kernel/scene/voxel_file/header.h"

namespace voxmelt::scene {
namespace {

constexpr std::int64_t kFarthest = 1'000'000;  // voxels: no scene of MagicaVoxel is so large

// Reads the numbers, texts and dictionaries of a chunk, one after the other.
class Content {
 public:
  Content(std::string_view bytes, const VoxelSource& source) : bytes_(bytes), source_(source) {}

  std::int32_t number() {
    const auto value = number_at<std::int32_t>(take(4));
    return value;
  }
  std::size_t count() {
    const std::int32_t value = number();
    if (value < 0 || static_cast<std::size_t>(value) > bytes_.size())
      source_.fail(fmt::format("a node of its scene has {} parts in {} bytes", value, bytes_.size()));
    return static_cast<std::size_t>(value);
  }
  std::string text() { return std::string(take(count())); }
  std::map<std::string, std::string> dictionary() {
    std::map<std::string, std::string> found;
    for (std::size_t left = count(); left > 0; --left) {
      std::string key = text();
      found[key] = text();
    }
    return found;
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) source_.fail("a node of its scene is truncated");
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }

  std::string_view bytes_;
  const VoxelSource& source_;
};

// Two bits say which coordinate makes the first row, two the second. The third is left. A bit for each row
// says whether it is negative.
void read_rotation(const std::string& text, Turn& turn, const VoxelSource& source) {
  const std::vector<double> numbers = numbers_in(text, "_r", source);
  const int bits =
      numbers.size() == 1 && numbers[0] >= 0 && numbers[0] <= 127 ? static_cast<int>(numbers[0]) : -1;
  const int first = bits & 3, second = bits >> 2 & 3;
  if (bits < 0 || first > 2 || second > 2 || first == second)
    source.fail(fmt::format("_r = {} is no rotation", in_quotes(text)));
  turn.from = {static_cast<std::size_t>(first), static_cast<std::size_t>(second),
               static_cast<std::size_t>(3 - first - second)};
  for (std::size_t row = 0; row < 3; ++row) turn.sign[row] = (bits >> (4 + row) & 1) != 0 ? -1 : 1;
}

void read_move(const std::string& text, Turn& turn, const VoxelSource& source) {
  const std::array<double, 3> numbers = three_lengths(text, "_t", source);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(std::abs(numbers[axis]) <= kFarthest) || numbers[axis] != std::floor(numbers[axis]))
      source.fail(fmt::format("_t = {} is no move", in_quotes(text)));
    turn.move[axis] = static_cast<std::int64_t>(numbers[axis]);
  }
}

}  // namespace

Place3 Turn::of(const Place3& place) const {
  return {sign[0] * place[from[0]], sign[1] * place[from[1]], sign[2] * place[from[2]]};
}

Turn Turn::after(const Turn& first) const {
  Turn both;
  const Place3 moved = of(first.move);
  for (std::size_t row = 0; row < 3; ++row) {
    both.from[row] = first.from[from[row]];
    both.sign[row] = sign[row] * first.sign[from[row]];
    both.move[row] = move[row] + moved[row];
  }
  return both;
}

void MagicaScene::read(std::string_view name, std::string_view bytes) {
  if (name != "nTRN" && name != "nGRP" && name != "nSHP" && name != "LAYR") return;
  Content content(bytes, source_);
  const Id id = content.number();
  auto words = content.dictionary();
  if (name == "LAYR") {
    if (words["_hidden"] == "1") hidden_layers_.insert(id);
    return;
  }
  const auto [place, is_new] = nodes_.try_emplace(id);
  if (!is_new) source_.fail(fmt::format("node {} of its scene is there twice", id));
  Node& node = place->second;
  node.is_hidden = words["_hidden"] == "1";
  if (name == "nTRN") {
    node.children.push_back(content.number());
    content.number();  // nothing yet, say its makers
    node.layer = content.number();
    if (content.count() == 0) return;
    auto frame = content.dictionary();
    if (frame.contains("_r")) read_rotation(frame["_r"], node.turn, source_);
    if (frame.contains("_t")) read_move(frame["_t"], node.turn, source_);
    return;
  }
  for (std::size_t left = content.count(); left > 0; --left) {
    (name == "nGRP" ? node.children : node.models).push_back(content.number());
    if (name == "nSHP") content.dictionary();
  }
}

// A node has one parent, so that the walk ends, and the root is node 0.
std::vector<PlacedModel> MagicaScene::models(std::size_t count) const {
  std::vector<PlacedModel> found;
  std::set<Id> seen{0};
  std::vector<Step> waiting{{}};
  while (!waiting.empty()) {
    const auto [id, turn] = waiting.back();
    waiting.pop_back();
    const auto place = nodes_.find(id);
    if (place == nodes_.end()) source_.fail(fmt::format("its scene has no node {}", id));
    const Node& node = place->second;
    if (node.is_hidden || hidden_layers_.contains(node.layer)) continue;
    const Turn here = turn.after(node.turn);
    for (const std::int64_t along : here.move)
      if (std::abs(along) > kFarthest) source_.fail(fmt::format("node {} of its scene is too far away", id));
    if (!node.models.empty()) {
      const Id model = node.models.front();
      if (model < 0 || static_cast<std::size_t>(model) >= count)
        source_.fail(fmt::format("its scene names model {} of {}", model, count));
      found.push_back({static_cast<std::size_t>(model), here});
    }
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      if (!seen.insert(*child).second)
        source_.fail(fmt::format("node {} of its scene has two parents", *child));
      waiting.push_back({*child, here});
    }
  }
  return found;
}

}  // namespace voxmelt::scene
