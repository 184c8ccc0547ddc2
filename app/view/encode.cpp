#include "app/view/encode.h"

#include <cstddef>
#include <cstdlib>
#include <cstring>

#include <jpeglib.h>

#include "render/image/png_bytes.h"

namespace voxmelt::view {

render::Image image_of(const Frame& frame) {
  render::Image image(frame.width, frame.height);
  const std::size_t row = 3 * static_cast<std::size_t>(frame.width);
  for (int y = 0; y < frame.height; ++y)
    std::memcpy(&image.at(0, y), frame.rgb.data() + static_cast<std::size_t>(y) * frame.stride, row);
  return image;
}

std::string png_of(const Frame& frame) { return render::png_bytes(image_of(frame)); }

// The library ends the program where memory runs out. Nothing else can go wrong with a picture of ours.
std::string jpeg_of(const Frame& frame) {
  constexpr int kQuality = 90;
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(frame.width);
  jpeg.image_height = static_cast<JDIMENSION>(frame.height);
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, kQuality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  for (int y = 0; y < frame.height; ++y) {
    auto* row = const_cast<JSAMPROW>(frame.rgb.data() + static_cast<std::size_t>(y) * frame.stride);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string result(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&jpeg);
  std::free(bytes);
  return result;
}

}  // namespace voxmelt::view
