#include "kernel/scene/mesh_file/gltf_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>

#include "kernel/scene/mesh_file/formats.h"
#include "kernel/scene/text/bytes.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

using nlohmann::json;

// JSON takes several times its size in memory.
constexpr std::size_t kLargestJson = std::size_t{64} << 20;

// A file may require these. None of them changes where the triangles are, but the last one, which is read.
constexpr std::array<std::string_view, 4> kExtensions{"KHR_texture_transform", "KHR_lights_punctual",
                                                      "KHR_texture_basisu", "KHR_mesh_quantization"};

std::size_t bytes_of(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case GltfData::kFloat:
      return 4;
    default:
      return 0;
  }
}

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

int value_of_digit(char c, std::string_view digits) {
  const std::size_t at = digits.find(c);
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

// Returns nothing if the text is no Base64.
std::optional<std::string> base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = value_of_digit(c, digits);
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

// Returns the name of a file, in which %20 stands for a blank.
std::string without_percents(std::string_view uri) {
  constexpr std::string_view digits = "0123456789abcdef0123456789ABCDEF";
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? value_of_digit(uri[i + 1], digits) : -1;
    const int low = high >= 0 ? value_of_digit(uri[i + 2], digits) : -1;
    if (low < 0) {
      name += uri[i];
    } else {
      name += static_cast<char>(high % 16 * 16 + low % 16);
      i += 2;
    }
  }
  return name;
}

}  // namespace

GltfData::GltfData(std::string_view bytes, const std::string& file, const Place& place)
    : file_(file), place_(place) {
  if (bytes.starts_with("glTF"))
    read_chunks(bytes);
  else
    parse(without_mark(bytes, place, file));
  check_extensions();
}

void GltfData::fail(const std::string& path, const std::string& message) const {
  fail_at(place_, fmt::format("{}: {}{}{}", file_, path, path.empty() ? "" : ": ", message));
}

void GltfData::read_chunks(std::string_view bytes) {
  constexpr std::size_t header = 12, chunk_header = 8;
  constexpr std::uint32_t json = 0x4E4F534A, binary = 0x004E4942;
  if (bytes.size() < header + chunk_header) fail("", "the file is truncated in its header");
  const auto version = number_at<std::uint32_t>(bytes.substr(4)),
             size = number_at<std::uint32_t>(bytes.substr(8));
  if (version != 2) fail("", fmt::format("version {} of glTF is not read, 2 is", version));
  if (size != bytes.size())
    fail("", fmt::format("its header says {} bytes, and the file has {}{}", size, bytes.size(),
                         bytes.size() < size ? ": is it truncated?" : ""));
  for (std::size_t at = header, chunk = 0; at < bytes.size(); ++chunk) {
    if (bytes.size() - at < chunk_header) fail("", fmt::format("chunk {} is truncated", chunk));
    const auto length = number_at<std::uint32_t>(bytes.substr(at));
    const auto type = number_at<std::uint32_t>(bytes.substr(at + 4));
    if (length > bytes.size() - at - chunk_header)
      fail("", fmt::format("chunk {} says {} bytes, more than the file has", chunk, length));
    const std::string_view content = bytes.substr(at + chunk_header, length);
    if (chunk == 0 && type != json) fail("", "its first chunk is no JSON");
    if (chunk == 0) parse(content);
    if (chunk == 1 && type == binary) {
      chunk_ = content;
      has_chunk_ = true;
    }
    at += chunk_header + length;
  }
}

void GltfData::parse(std::string_view written) {
  if (written.size() > kLargestJson)
    fail("", fmt::format("more than {} bytes of JSON; a .glb file keeps its numbers apart", kLargestJson));
  try {
    json_ = json::parse(written);
  } catch (const json::parse_error& error) {
    fail("", fmt::format("byte {} of its JSON is wrong{}", error.byte,
                         error.byte > written.size() ? ": is it truncated?" : ""));
  } catch (const json::exception&) {
    fail("", "its JSON has a number that is too large");
  }
  if (!json_.is_object()) fail("", "its JSON is no object");
  const std::string version = has(root(), "asset") ? text(object(root(), "asset"), "version") : "";
  if (!version.starts_with("2."))
    fail("asset.version",
         version.empty() ? "is missing: this is no glTF 2" : in_quotes(version) + " is not read, 2.0 is");
}

void GltfData::check_extensions() const {
  if (!has(root(), "extensionsRequired")) return;
  const json& list = json_["extensionsRequired"];
  for (const json& name : list) {
    const std::string text = name.is_string() ? name.get<std::string>() : "";
    const bool known = std::find(kExtensions.begin(), kExtensions.end(), text) != kExtensions.end();
    if (!known && !text.starts_with("KHR_materials_"))
      fail("extensionsRequired", in_quotes(text) + " is not read; export the model without it");
  }
}

GltfValue GltfData::object(const GltfValue& holder, const char* key) const {
  const std::string path = joined(holder.path, key);
  if (!has(holder, key)) fail(path, "is missing");
  const json& value = (*holder.json)[key];
  if (!value.is_object()) fail(path, "is no object");
  return {&value, path};
}

std::vector<GltfValue> GltfData::objects(const GltfValue& holder, const char* key) const {
  std::vector<GltfValue> result;
  if (!has(holder, key)) return result;
  const json& list = (*holder.json)[key];
  const std::string path = joined(holder.path, key);
  if (!list.is_array()) fail(path, "is no list");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string item = fmt::format("{}.{}", path, i);
    if (!list[i].is_object()) fail(item, "is no object");
    result.push_back({&list[i], item});
  }
  return result;
}

GltfValue GltfData::listed(const char* list, std::uint64_t index, const std::string& by) const {
  const json* values = has(root(), list) ? &json_[list] : nullptr;
  if (values == nullptr || !values->is_array() || index >= values->size())
    fail(by, fmt::format("there is no {}.{}", list, index));
  const std::string path = fmt::format("{}.{}", list, index);
  const json& value = (*values)[index];
  if (!value.is_object()) fail(path, "is no object");
  return {&value, path};
}

std::uint64_t GltfData::whole(const GltfValue& holder, const char* key) const {
  const std::string path = joined(holder.path, key);
  if (!has(holder, key)) fail(path, "is missing");
  const json& value = (*holder.json)[key];
  if (!value.is_number_unsigned()) fail(path, "is no whole number from 0 on");
  return value.get<std::uint64_t>();
}

std::vector<std::uint64_t> GltfData::wholes(const GltfValue& holder, const char* key) const {
  std::vector<std::uint64_t> result;
  if (!has(holder, key)) return result;
  const json& list = (*holder.json)[key];
  const std::string path = joined(holder.path, key);
  if (!list.is_array()) fail(path, "is no list");
  for (const json& value : list) {
    if (!value.is_number_unsigned()) fail(path, "has something else than whole numbers");
    result.push_back(value.get<std::uint64_t>());
  }
  return result;
}

std::vector<double> GltfData::numbers(const GltfValue& holder, const char* key, std::size_t count) const {
  const json& list = (*holder.json)[key];
  const std::string path = joined(holder.path, key);
  if (!list.is_array() || list.size() != count) fail(path, fmt::format("must be {} numbers", count));
  std::vector<double> result;
  for (const json& value : list) {
    if (!value.is_number() || !is_coordinate(value.get<double>()))
      fail(path, "has something else than numbers");
    result.push_back(value.get<double>());
  }
  return result;
}

std::string GltfData::text(const GltfValue& holder, const char* key) const {
  if (!has(holder, key)) return {};
  const json& value = (*holder.json)[key];
  if (!value.is_string()) fail(joined(holder.path, key), "is no text");
  return value.get<std::string>();
}

std::string GltfData::load(const GltfValue& buffer) const {
  const std::string uri = text(buffer, "uri"), path = buffer.path + ".uri";
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(";base64,");
    const auto bytes =
        comma == std::string::npos ? std::nullopt : base64(std::string_view(uri).substr(comma + 8));
    if (!bytes) fail(path, "holds data that are no Base64");
    return *bytes;
  }
  const std::string name = without_percents(uri);
  if (name.empty() || name.find("://") != std::string::npos || name.find('\0') != std::string::npos)
    fail(path, in_quotes(name) + " is no file beside this one");
  return read_text_file(std::filesystem::path(file_).parent_path() / name, kLargestMeshFile,
                        place_.text() + ": error: " + file_ + ": " + path);
}

std::string_view GltfData::buffer(std::uint64_t index, const std::string& by) {
  const GltfValue buffer = listed("buffers", index, by);
  const std::uint64_t length = whole(buffer, "byteLength");
  std::string_view bytes = chunk_;
  if (has(buffer, "uri")) {
    const auto [entry, is_new] = loaded_.try_emplace(index);
    if (is_new) entry->second = load(buffer);
    bytes = entry->second;
  } else if (index != 0 || !has_chunk_) {
    fail(buffer.path, "has no uri, and the file has no binary chunk for it");
  }
  if (length > bytes.size())
    fail(buffer.path, fmt::format("says {} bytes, and has {}: is it truncated?", length, bytes.size()));
  return bytes.substr(0, length);
}

GltfData::Numbers GltfData::accessor(std::uint64_t index, const char* type, std::size_t columns,
                                     const std::string& by) {
  const GltfValue accessor = listed("accessors", index, by);
  if (has(accessor, "sparse")) fail(accessor.path + ".sparse", "is not read; export the model without it");
  if (text(accessor, "type") != type)
    fail(accessor.path + ".type", fmt::format("must be {} for {}", type, by));
  Numbers result;
  result.rows = whole(accessor, "count");
  result.type = whole(accessor, "componentType");
  const std::size_t size = bytes_of(result.type) * columns;
  if (size == 0) fail(accessor.path + ".componentType", fmt::format("{} is none", result.type));
  result.normalised = has(accessor, "normalized") && (*accessor.json)["normalized"] == true;
  const GltfValue view = listed("bufferViews", whole(accessor, "bufferView"), accessor.path + ".bufferView");
  result.stride = whole(view, "byteStride", size);
  if (result.stride < size || result.stride > 4096)
    fail(view.path + ".byteStride", fmt::format("{} is not within {}..4096", result.stride, size));

  // Nothing may reach beyond what holds it. No sum may overflow.
  const std::string_view all = buffer(whole(view, "buffer"), view.path + ".buffer");
  const std::uint64_t view_at = whole(view, "byteOffset", 0), view_size = whole(view, "byteLength");
  if (view_at > all.size() || view_size > all.size() - view_at)
    fail(view.path, fmt::format("bytes {} to {} + {} are not within its buffer of {}", view_at, view_at,
                                view_size, all.size()));
  const std::uint64_t at = whole(accessor, "byteOffset", 0);
  const std::uint64_t room = at > view_size ? 0 : view_size - at;
  if (result.rows > 0 && (room < size || result.rows - 1 > (room - size) / result.stride))
    fail(accessor.path, fmt::format("{} times {} bytes are not within its view of {}", result.rows,
                                    result.stride, view_size));
  result.bytes = all.substr(view_at + std::min(at, view_size), room);
  return result;
}

double GltfData::Numbers::at(std::size_t row, std::size_t column) const {
  const std::string_view from = bytes.substr(row * stride + column * bytes_of(type));
  const auto whole = [&](auto value) {
    const double largest = std::numeric_limits<decltype(value)>::max();
    return normalised ? std::max(value / largest, -1.0) : static_cast<double>(value);
  };
  switch (type) {
    case 5120:
      return whole(number_at<std::int8_t>(from));
    case 5121:
      return whole(number_at<std::uint8_t>(from));
    case 5122:
      return whole(number_at<std::int16_t>(from));
    case 5123:
      return whole(number_at<std::uint16_t>(from));
    case 5125:
      return whole(number_at<std::uint32_t>(from));
    default:
      return number_at<float>(from);
  }
}

}  // namespace voxmelt::scene
