// The reader of PLY, as text and in both orders of bytes. It takes the coordinates of the element `vertex`
// and the list `vertex_indices` of the element `face`. Everything else is passed over.
#include "kernel/scene/mesh_file/ply.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/scene/mesh_file/formats.h"
#include "kernel/scene/mesh_file/words.h"
#include "kernel/scene/text/bytes.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

// Gives the numbers of an element one after another, from words or from bytes.
class Numbers {
 public:
  Numbers(const PlyHeader& header, std::string_view body, const std::string& file, const Place& place)
      : coding_(header.coding),
        body_(body),
        lines_(body),
        header_lines_(header.lines),
        file_(file),
        place_(place) {}

  // Begins the next row of an element, and ends the one before.
  void begin_row(const PlyElement& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
    if (coding_ != PlyCoding::text) return;
    const std::optional<std::string_view> line = lines_.next();
    if (!line) fail("is missing: is the file truncated?");
    line_ = *line;
  }
  void end_row() {
    if (coding_ == PlyCoding::text && !rest_of(line_).empty())
      fail(fmt::format("has more than its numbers: {}", in_quotes(rest_of(line_))));
  }

  double next(PlyType type) {
    if (coding_ == PlyCoding::text) return next_word(type);
    const std::size_t bytes = bytes_of(type);
    if (body_.size() < bytes) fail("is not whole: is the file truncated?");
    const double number = number_of(type);
    body_.remove_prefix(bytes);
    return number;
  }

  void skip(const PlyProperty& property) {
    std::uint64_t count = 1;
    if (property.is_list) count = length(property);
    if (coding_ == PlyCoding::text) {
      for (; count > 0; --count) next_word(property.type);
      return;
    }
    if (count > body_.size() / bytes_of(property.type)) fail("is not whole: is the file truncated?");
    body_.remove_prefix(count * bytes_of(property.type));
  }

  std::uint64_t length(const PlyProperty& property) {
    const double count = next(property.count);
    if (count < 0) fail(fmt::format("has a list of {} numbers", count));
    return static_cast<std::uint64_t>(count);
  }

  // Fails if so many rows cannot be there. It is asked before memory is taken for them.
  void expect_rows(const PlyElement& element) {
    std::size_t least = 0;  // bytes, or signs, of a row
    for (const PlyProperty& property : element.properties)
      least += coding_ == PlyCoding::text ? 2 : bytes_of(property.is_list ? property.count : property.type);
    const std::size_t left = coding_ == PlyCoding::text ? lines_.left().size() + 1 : body_.size();
    if (least > 0 && element.count > left / least)
      fail_at(place_, fmt::format("{}: {} times `{}` do not fit into the rest of the file: is it truncated?",
                                  file_, element.count, element.name));
  }

  std::size_t bytes_left() const { return coding_ == PlyCoding::text ? 0 : body_.size(); }

  [[noreturn]] void fail(const std::string& what) const {
    const std::string line =
        coding_ == PlyCoding::text ? fmt::format(":{}", header_lines_ + lines_.number()) : "";
    fail_at(place_, fmt::format("{}{}: {} {} {}", file_, line, element_->name, row_, what));
  }

 private:
  double next_word(PlyType type) {
    const std::string_view word = take_word(line_);
    if (word.empty()) fail("has too few numbers: is the file truncated?");
    if (!is_whole(type)) {
      const std::optional<double> number = real_number_in(word);
      if (!number) fail(in_quotes(word) + " is no number");
      return *number;
    }
    const std::optional<std::int64_t> number = whole_number_in(word);
    if (!number || *number < INT32_MIN || *number > UINT32_MAX) fail(in_quotes(word) + " is no whole number");
    return static_cast<double>(*number);
  }

  double number_of(PlyType type) const {
    const bool big = coding_ == PlyCoding::big_endian;
    switch (type) {
      case PlyType::int8:
        return number_at<std::int8_t>(body_, big);
      case PlyType::uint8:
        return number_at<std::uint8_t>(body_, big);
      case PlyType::int16:
        return number_at<std::int16_t>(body_, big);
      case PlyType::uint16:
        return number_at<std::uint16_t>(body_, big);
      case PlyType::int32:
        return number_at<std::int32_t>(body_, big);
      case PlyType::uint32:
        return number_at<std::uint32_t>(body_, big);
      case PlyType::float32:
        return number_at<float>(body_, big);
      case PlyType::float64:
        break;
    }
    return number_at<double>(body_, big);
  }

  PlyCoding coding_;
  std::string_view body_;  // bytes that are left
  Lines lines_;
  std::string_view line_;  // words that are left
  std::int64_t header_lines_;
  const std::string& file_;
  const Place& place_;
  const PlyElement* element_ = nullptr;
  std::uint64_t row_ = 0;
};

class PlyReader {
 public:
  PlyReader(const PlyHeader& header, std::string_view body, const std::string& file, const Place& place)
      : header_(header), numbers_(header, body, file, place), file_(file), place_(place) {
    for (const PlyElement& element : header.elements)
      if (element.name == "vertex") vertices_ = element.count;
  }

  Mesh read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      numbers_.expect_rows(element);
      if (element.name == "vertex")
        vertices(element);
      else if (element.name == "face")
        faces(element);
      else
        pass_over(element);
    }
    if (numbers_.bytes_left() > 0)
      fail_at(place_, fmt::format("{}: {} bytes behind its last element", file_, numbers_.bytes_left()));
    if (mesh_.vertices.empty()) fail_at(place_, file_ + ": the mesh has no vertices");
    if (mesh_.ends.empty()) fail_at(place_, file_ + ": the mesh has no faces");
    return std::move(mesh_);
  }

 private:
  void vertices(const PlyElement& element) {
    std::array<std::size_t, 3> axes{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axes[axis] = element.find(std::string_view("xyz").substr(axis, 1));
      if (axes[axis] == element.properties.size() || element.properties[axes[axis]].is_list)
        fail_at(place_, fmt::format("{}: a vertex has no number {}", file_, "xyz"[axis]));
    }
    if (!mesh_.vertices.empty()) fail_at(place_, file_ + ": `vertex` is there twice");
    mesh_.vertices.reserve(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      numbers_.begin_row(element, row);
      Point point;
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i != axes[0] && i != axes[1] && i != axes[2]) {
          numbers_.skip(element.properties[i]);
          continue;
        }
        const double value = numbers_.next(element.properties[i].type);
        if (!is_coordinate(value)) numbers_.fail(fmt::format("has {}, which is not a coordinate", value));
        (i == axes[0] ? point.x : i == axes[1] ? point.y : point.z) = value;
      }
      numbers_.end_row();
      mesh_.vertices.push_back(point);
    }
  }

  void faces(const PlyElement& element) {
    std::size_t list = element.find("vertex_indices");
    if (list == element.properties.size()) list = element.find("vertex_index");
    if (list == element.properties.size() || !element.properties[list].is_list ||
        !is_whole(element.properties[list].type))
      fail_at(place_, file_ + ": a face has no list vertex_indices of whole numbers");
    for (std::uint64_t row = 0; row < element.count; ++row) {
      numbers_.begin_row(element, row);
      for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (i == list)
          face(element.properties[i]);
        else
          numbers_.skip(element.properties[i]);
      numbers_.end_row();
    }
  }

  void face(const PlyProperty& list) {
    const std::uint64_t corners = numbers_.length(list);
    for (std::uint64_t k = 0; k < corners; ++k) {
      const double index = numbers_.next(list.type);
      if (index < 0 || index >= static_cast<double>(vertices_))
        numbers_.fail(fmt::format("names vertex {}, and there are {}, from 0 on", index, vertices_));
      mesh_.corners.push_back(static_cast<std::uint32_t>(index));
    }
    if (corners < 3) {
      mesh_.corners.resize(mesh_.corners.size() - corners);
      ++mesh_.short_faces;
      return;
    }
    mesh_.ends.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
  }

  void pass_over(const PlyElement& element) {
    for (std::uint64_t row = 0; row < element.count; ++row) {
      numbers_.begin_row(element, row);
      for (const PlyProperty& property : element.properties) numbers_.skip(property);
      numbers_.end_row();
    }
  }

  const PlyHeader& header_;
  Numbers numbers_;
  const std::string& file_;
  const Place& place_;
  std::uint64_t vertices_ = 0;  // that the header promises
  Mesh mesh_;
};

}  // namespace

Mesh read_ply(std::string_view bytes, const std::string& file, const Place& place) {
  if (!bytes.starts_with("ply")) bytes = without_mark(bytes, place, file);
  const PlyHeader header = read_ply_header(bytes, file, place);
  return PlyReader(header, bytes.substr(header.bytes), file, place).read();
}

}  // namespace voxmelt::scene
