#include "render/image/zlib_bytes.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace voxmelt::render {
namespace {

constexpr int kLevel = 1;  // higher levels save a few percent and take up to twice as long

struct Free {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

}  // namespace

std::string zlib_bytes(std::string_view plain) {
  const std::unique_ptr<libdeflate_compressor, Free> compressor(libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::string text(libdeflate_zlib_compress_bound(compressor.get(), plain.size()), '\0');
  text.resize(
      libdeflate_zlib_compress(compressor.get(), plain.data(), plain.size(), text.data(), text.size()));
  return text;
}

}  // namespace voxmelt::render
