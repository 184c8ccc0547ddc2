#include "kernel/scene/shape/tiff_file.h"

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace voxmelt::scene {
namespace {

constexpr tmsize_t kLargestTable = tmsize_t{64} << 20;  // bytes that libtiff itself may take at once

tmsize_t read_some(thandle_t handle, void* to, tmsize_t size) {
  TiffSource& source = *static_cast<TiffSource*>(handle);
  const std::uint64_t left = source.bytes.size() - std::min<std::uint64_t>(source.at, source.bytes.size());
  const std::uint64_t count = std::min<std::uint64_t>(left, size > 0 ? static_cast<std::uint64_t>(size) : 0);
  if (count > 0) std::memcpy(to, source.bytes.data() + source.at, count);
  source.at += count;
  return static_cast<tmsize_t>(count);
}
tmsize_t write_none(thandle_t, void*, tmsize_t) { return 0; }
toff_t seek(thandle_t handle, toff_t to, int from) {
  TiffSource& source = *static_cast<TiffSource*>(handle);
  source.at = from == SEEK_SET ? to : from == SEEK_CUR ? source.at + to : source.bytes.size() + to;
  return source.at;
}
int close_none(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return static_cast<TiffSource*>(handle)->bytes.size(); }
int map_all(thandle_t handle, void** base, toff_t* size) {
  TiffSource& source = *static_cast<TiffSource*>(handle);
  *base = source.bytes.data();
  *size = source.bytes.size();
  return 1;
}
void unmap_none(thandle_t, void*, toff_t) {}

// A message of libtiff is a format of C, and its numbers say little to a user: the words before them stay.
int note(TIFF*, void* user, const char*, const char* format, va_list) {
  std::string& problem = static_cast<TiffSource*>(user)->problem;
  if (!problem.empty()) return 1;
  const std::string_view words = format;
  problem = words.substr(0, words.find('%'));
  while (!problem.empty() && std::string_view(" ,;:\"'(").find(problem.back()) != std::string_view::npos)
    problem.pop_back();
  if (problem.empty()) problem = "its tags or its data are damaged";
  return 1;
}
int pass_over(TIFF*, void*, const char*, const char*, va_list) { return 1; }

TiffFile::Handle opened(TiffSource& source) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kLargestTable);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), note, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), pass_over, nullptr);
  return TiffFile::Handle(TIFFClientOpenExt("heights", "r", &source, read_some, write_none, seek, close_none,
                                            size_of, map_all, unmap_none, options.get()));
}

}  // namespace

TiffFile::TiffFile(std::string bytes) {
  source_->bytes = std::move(bytes);
  handle_ = opened(*source_);
}

void TiffFile::Close::operator()(TIFF* tiff) const { TIFFClose(tiff); }

}  // namespace voxmelt::scene
