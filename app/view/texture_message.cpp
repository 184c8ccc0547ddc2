#include "app/view/texture_message.h"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "render/image/zlib_bytes.h"

namespace voxmelt::view {
namespace {

using json = nlohmann::ordered_json;

const char* name_of(TexelFormat format) {
  constexpr const char* kNames[] = {"u16", "u8x4", "u32x2", "u32x4", "i32", "i32x2"};
  return kNames[static_cast<std::size_t>(format)];
}

std::string description_of(const Textures& textures) {
  json list = json::array(), numbers = json::object();
  for (const Texture& one : textures.textures)
    list.push_back(
        {{"name", one.name}, {"format", name_of(one.format)}, {"size", one.size}, {"brick", one.brick}});
  for (const TextureNumbers& one : textures.numbers) numbers[std::string(one.name)] = one.values;
  return json{{"version", textures.version},
              {"everything", textures.everything},
              {"textures", list},
              {"numbers", numbers},
              {"bricks", textures.bricks.size()}}
      .dump();
}

void append(std::string& to, std::uint32_t number, int bytes) {
  for (int i = 0; i < bytes; ++i) to += static_cast<char>(number >> (8 * i) & 0xFF);
}

}  // namespace

std::string packed(const Textures& textures) {
  constexpr std::size_t kAligned = 8;  // so that the page can read numbers of 32 bits in place
  std::string text = description_of(textures), plain;
  while ((text.size() + 4) % kAligned != 0) text += ' ';
  append(plain, static_cast<std::uint32_t>(text.size()), 4);
  plain += text;
  for (const TextureBrick& brick : textures.bricks) {
    append(plain, static_cast<std::uint32_t>(brick.texture), 2);
    for (const int at : brick.at) append(plain, static_cast<std::uint32_t>(at), 2);
    plain.append(reinterpret_cast<const char*>(brick.bytes.data()), brick.bytes.size());
  }
  return render::zlib_bytes(plain);
}

}  // namespace voxmelt::view
