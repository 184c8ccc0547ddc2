// A film is MP4 by ffmpeg, or WebP by ourselves.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "render/frames/webp_film.h"
#include "render/image/image.h"
#include "render/image/video.h"

namespace voxmelt::render {

// With `automatic` a film is WebP only where ffmpeg is missing or fails.
enum class FilmKind { automatic, mp4, webp, webp_lossless };
inline constexpr std::array<std::string_view, 4> kFilmNames{"auto", "mp4", "webp", "webp-lossless"};
std::optional<FilmKind> film_kind_named(std::string_view name);
bool wants_webp(FilmKind kind);  // and nothing else

// Says what became of a film.
struct FilmMade {
  std::filesystem::path file;  // empty if there is none
  std::string note;            // why there is none, or why it is no MP4; else empty
};

class FilmWriter {
 public:
  struct Plan {
    FilmKind kind = FilmKind::automatic;
    int frames_per_second = 12;
    Patience patience{};
    // Gives a frame again, if ffmpeg has failed after it took some. May be empty: then there is no film.
    std::function<Image(std::size_t)> read{};
  };

  // The film's file is `base` with .mp4 or .webp.
  FilmWriter(std::filesystem::path base, Plan plan);

  // Nothing here throws, and frames after a problem are ignored.
  void add(const Image& frame);  // all frames have one size
  void close();                  // no more frames come: ffmpeg may need a while to end
  FilmMade finish();

 private:
  std::filesystem::path with(const char* ending) const { return base_.string() + ending; }
  bool may_be_webp() const;
  WebpFilm& begin_webp();
  FilmMade webp_made(const std::string& note);
  FilmMade made_again(const std::string& problem);

  std::filesystem::path base_;
  Plan plan_;
  std::size_t frames_ = 0;
  std::optional<VideoWriter> mp4_;
  std::optional<WebpFilm> webp_;
  std::string no_mp4_;  // why WebP took its place
};

}  // namespace voxmelt::render
