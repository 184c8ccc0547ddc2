// The reader of Wavefront OBJ.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/scene/mesh_file/formats.h"
#include "kernel/scene/mesh_file/words.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

// Reads the data that shapes need. Materials, normals and texture coordinates can be wrong without harm.
class ObjReader {
 public:
  ObjReader(const std::string& file, const Place& place) : file_(file), place_(place) {}

  Mesh read(std::string_view text) {
    line_end_ = line_end_of(text);
    while (!text.empty()) {
      std::string_view line = take_line(text);
      const std::string_view kind = take_word(line);
      if (kind == "v") vertex(line);
      if (kind == "f") face(line, text.empty());
      if (kind == "o" || kind == "g") mesh_.parts.push_back({std::string(rest_of(line)), mesh_.faces()});
    }
    if (mesh_.vertices.empty()) fail_at(place_, fmt::format("{}: the mesh has no vertices", file_));
    if (mesh_.ends.empty()) fail_at(place_, fmt::format("{}: the mesh has no faces", file_));
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    fail_at(place_, fmt::format("{}:{}: {}", file_, line_, message));
  }

  // Takes a line without its comment. It is joined with the lines behind it, as long as each ends with a
  // backslash.
  std::string_view take_line(std::string_view& text) {
    joined_.clear();
    for (;;) {
      ++line_;
      const std::size_t end = std::min(text.find(line_end_), text.size());
      std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1))
        if (at == 0 || kBlanks.find(line[at - 1]) != std::string_view::npos) line = line.substr(0, at);
      const std::size_t last = line.find_last_not_of(kBlanks);
      const bool goes_on = last != std::string_view::npos && line[last] == '\\' && !text.empty();
      if (joined_.empty() && !goes_on) return line;
      joined_ += goes_on ? line.substr(0, last) : line;
      if (!goes_on) return joined_;
      joined_ += ' ';
    }
  }

  double coordinate(std::string_view& line) const {
    const std::string_view word = take_word(line);
    if (word.empty()) fail("a vertex needs 3 coordinates: is the file truncated?");
    const std::optional<double> value = coordinate_in(word);
    if (!value) fail(fmt::format("{} is not a coordinate", in_quotes(word)));
    return *value;
  }

  void vertex(std::string_view line) {
    const double x = coordinate(line), y = coordinate(line), z = coordinate(line);
    mesh_.vertices.push_back({x, y, z});
  }

  void face(std::string_view line, bool is_last) {
    const std::int64_t known = mesh_.vertices.size();
    int corners = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++corners) {
      const std::optional<std::int64_t> index = whole_number_in(word.substr(0, word.find('/')));
      if (!index) fail(fmt::format("{} is not a vertex of a face", in_quotes(word)));
      if (*index == 0 || *index > known || *index < -known)
        fail(fmt::format("a face names vertex {}, but {} vertices are known here", *index, known));
      mesh_.corners.push_back(static_cast<std::uint32_t>(*index > 0 ? *index - 1 : known + *index));
    }
    if (corners < 3 && is_last)
      fail(fmt::format("a face needs 3 corners, not {}: is the file truncated?", corners));
    if (corners < 3) {
      mesh_.corners.resize(mesh_.corners.size() - corners);
      ++mesh_.short_faces;
      return;
    }
    mesh_.ends.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
  }

  const std::string& file_;
  const Place& place_;
  std::int64_t line_ = 0;
  char line_end_ = '\n';
  std::string joined_;  // lines joined into one
  Mesh mesh_;
};

}  // namespace

Mesh read_obj(std::string_view bytes, const std::string& file, const Place& place) {
  return ObjReader(file, place).read(without_mark(bytes, place, file));
}

}  // namespace voxmelt::scene
