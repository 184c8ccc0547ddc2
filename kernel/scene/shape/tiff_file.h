// A TIFF in memory, read by libtiff. Its messages are kept instead of printed, and what it takes is bounded.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace voxmelt::scene {

// Holds the bytes of a file, and where libtiff stands in them.
struct TiffSource {
  std::string bytes;
  std::uint64_t at = 0;
  std::string problem;  // the first one
};

class TiffFile {
 public:
  struct Close {
    void operator()(TIFF* tiff) const;
  };
  using Handle = std::unique_ptr<TIFF, Close>;

  explicit TiffFile(std::string bytes);

  TIFF* get() const { return handle_.get(); }  // nothing if it is no TIFF
  const std::string& problem() const { return source_->problem; }
  std::uint64_t size() const { return source_->bytes.size(); }

  // Returns the value of a tag, or its default.
  template <class Value>
  Value tag(std::uint32_t number, Value otherwise) const {
    Value value = otherwise;
    return TIFFGetFieldDefaulted(get(), number, &value) == 1 ? value : otherwise;
  }

  // Returns the values of a tag that libtiff does not know itself, if they are of this type.
  template <class Value>
  std::pair<const Value*, std::uint32_t> foreign_tag(std::uint32_t number, TIFFDataType type) const {
    const TIFFField* const field = TIFFFindField(get(), number, TIFF_ANY);
    std::uint32_t count = 0;
    const Value* values = nullptr;
    if (field == nullptr || TIFFFieldDataType(field) != type || TIFFFieldPassCount(field) == 0 ||
        TIFFFieldReadCount(field) != TIFF_VARIABLE2 || TIFFGetField(get(), number, &count, &values) != 1 ||
        values == nullptr)
      return {nullptr, 0};
    return {values, count};
  }

 private:
  std::unique_ptr<TiffSource> source_ = std::make_unique<TiffSource>();  // libtiff has its address
  Handle handle_;
};

}  // namespace voxmelt::scene
