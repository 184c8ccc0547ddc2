// The parts of a glTF file: its JSON, its buffers, and the numbers that accessors take out of them. Whatever
// the file says is checked before it is used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Is a value of the JSON, with its path for messages: "meshes.0.primitives.1".
struct GltfValue {
  const nlohmann::json* json = nullptr;
  std::string path;
};

class GltfData {
 public:
  // Takes a .gltf or .glb file apart. It throws InputError with `place` and the file, as all of this does.
  GltfData(std::string_view bytes, const std::string& file, const Place& place);

  [[noreturn]] void fail(const std::string& path, const std::string& message) const;

  bool has(const GltfValue& object, const char* key) const { return object.json->contains(key); }
  GltfValue root() const { return {&json_, ""}; }
  GltfValue object(const GltfValue& holder, const char* key) const;
  // Gives the objects of a list, or none if the key is missing.
  std::vector<GltfValue> objects(const GltfValue& holder, const char* key) const;
  // Gives an object of a list at the root, by its index.
  GltfValue listed(const char* list, std::uint64_t index, const std::string& by) const;
  std::uint64_t whole(const GltfValue& holder, const char* key) const;
  std::uint64_t whole(const GltfValue& holder, const char* key, std::uint64_t fallback) const {
    return has(holder, key) ? whole(holder, key) : fallback;
  }
  std::vector<std::uint64_t> wholes(const GltfValue& holder, const char* key) const;  // none if it is missing
  std::vector<double> numbers(const GltfValue& holder, const char* key, std::size_t count) const;
  std::string text(const GltfValue& holder, const char* key) const;  // empty if it is missing

  // An accessor: so many rows of so many numbers, all within its buffer.
  struct Numbers {
    std::string_view bytes;
    std::size_t rows = 0, stride = 0;
    std::uint64_t type = 0;   // as glTF numbers them: 5126 is float
    bool normalised = false;  // whole numbers stand for -1..1 or 0..1
    double at(std::size_t row, std::size_t column) const;
  };
  static constexpr std::uint64_t kFloat = 5126;
  Numbers accessor(std::uint64_t index, const char* type, std::size_t columns, const std::string& by);

 private:
  void read_chunks(std::string_view bytes);
  void parse(std::string_view written);
  void check_extensions() const;
  std::string_view buffer(std::uint64_t index, const std::string& by);
  std::string load(const GltfValue& buffer) const;

  const std::string& file_;
  const Place& place_;
  nlohmann::json json_;
  std::string_view chunk_;  // bytes of a .glb
  bool has_chunk_ = false;
  std::map<std::uint64_t, std::string> loaded_;
};

}  // namespace voxmelt::scene
