#include "render/frames/webp_bytes.h"

#include <webp/encode.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "render/image/png.h"

namespace voxmelt::render {
namespace {

constexpr float kQuality = 90;  // of 100: errors of a few levels of 255
constexpr int kLosslessLevel =
    1;  // of 9: the next one takes twice the time, for some hundredths of the bytes
constexpr std::size_t kFileHeader = 12;  // RIFF, size, WEBP: a film has one of its own

struct Packed {
  Packed() { WebPMemoryWriterInit(&writer); }
  Packed(const Packed&) = delete;
  Packed& operator=(const Packed&) = delete;
  ~Packed() {
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&writer);
  }

  WebPPicture picture{};
  WebPMemoryWriter writer{};
};

[[noreturn]] void fail(int code) {
  throw ImageError(code == VP8_ENC_ERROR_OUT_OF_MEMORY || code == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY
                       ? "libwebp has not enough memory for a frame"
                       : "libwebp refuses a frame with its error " + std::to_string(code));
}

}  // namespace

bool webp_is_built_in() { return true; }

std::string webp_bytes(const Image& image, const Rectangle& part, bool lossless) {
  WebPConfig config;
  Packed packed;
  if (!WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, kQuality) || !WebPPictureInit(&packed.picture))
    throw ImageError("libwebp is another version than the one of its headers");
  if (lossless) WebPConfigLosslessPreset(&config, kLosslessLevel);

  WebPPicture& picture = packed.picture;
  picture.use_argb = lossless ? 1 : 0;
  picture.width = part.width;
  picture.height = part.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &packed.writer;
  const auto* first = reinterpret_cast<const std::uint8_t*>(&image.at(part.x, part.y));
  if (!WebPPictureImportRGB(&picture, first, image.width * static_cast<int>(sizeof(Rgb))))
    fail(VP8_ENC_ERROR_OUT_OF_MEMORY);
  if (!WebPEncode(&config, &picture)) fail(picture.error_code);
  return {reinterpret_cast<const char*>(packed.writer.mem) + kFileHeader, packed.writer.size - kFileHeader};
}

}  // namespace voxmelt::render
