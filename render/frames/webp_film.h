// A film without another program: an animated WebP, written frame by frame.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "render/image/image.h"

namespace voxmelt::render {

// Writes an animated WebP, a chunk for each frame, of the part that has changed. Memory holds one frame. A
// missing film is worth a message, not the end of a run. So nothing here throws, and frames after a problem
// are ignored.
class WebpFilm {
 public:
  // Without loss, every pixel is that of its frame. Otherwise it is close to it.
  WebpFilm(std::filesystem::path file, int frames_per_second, bool lossless);
  WebpFilm(const WebpFilm&) = delete;
  WebpFilm& operator=(const WebpFilm&) = delete;
  ~WebpFilm();  // without finish() there is no film, and nothing is left

  void add(const Image& frame);  // all frames have one size

  // Renames the film into its place. If there is none, the call returns the reason.
  std::optional<std::string> finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void begin(const Image& frame);
  void write(const std::string& bytes);
  void give_up(const std::string& problem);
  std::uint32_t milliseconds() const;  // that the next frame is seen

  std::filesystem::path file_, beside_;
  int frames_per_second_;
  bool lossless_;
  std::unique_ptr<std::FILE, Close> stream_;
  std::uint64_t bytes_ = 0, frames_ = 0;  // written so far
  Image last_;
  std::string problem_;
};

}  // namespace voxmelt::render
