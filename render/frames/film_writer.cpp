#include "render/frames/film_writer.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "render/frames/webp_bytes.h"

namespace voxmelt::render {
namespace {

// The reason alone: whoever shows it names the film.
std::string reason(const std::string& problem) {
  constexpr std::string_view kBefore = "no film: ";
  const std::size_t at = problem.find(kBefore);
  return at == std::string::npos ? problem : problem.substr(at + kBefore.size());
}

}  // namespace

std::optional<FilmKind> film_kind_named(std::string_view name) {
  const auto* const found = std::ranges::find(kFilmNames, name);
  if (found == kFilmNames.end()) return std::nullopt;
  return static_cast<FilmKind>(found - kFilmNames.begin());
}

bool wants_webp(FilmKind kind) { return kind == FilmKind::webp || kind == FilmKind::webp_lossless; }

FilmWriter::FilmWriter(std::filesystem::path base, Plan plan)
    : base_(std::move(base)), plan_(std::move(plan)) {
  if (wants_webp(plan_.kind))
    begin_webp();
  else
    mp4_.emplace(with(".mp4"), plan_.frames_per_second, plan_.patience);
}

bool FilmWriter::may_be_webp() const { return plan_.kind == FilmKind::automatic && webp_is_built_in(); }

WebpFilm& FilmWriter::begin_webp() {
  return webp_.emplace(with(".webp"), plan_.frames_per_second, plan_.kind == FilmKind::webp_lossless);
}

void FilmWriter::add(const Image& frame) {
  ++frames_;
  if (webp_) return webp_->add(frame);
  mp4_->add(frame);
  if (frames_ > 1 || !mp4_->gave_up() || !may_be_webp()) return;
  no_mp4_ = reason(mp4_->finish().value_or(""));
  mp4_.reset();
  begin_webp().add(frame);
}

void FilmWriter::close() {
  if (mp4_) mp4_->close();
}

FilmMade FilmWriter::webp_made(const std::string& note) {
  const std::optional<std::string> problem = webp_->finish();
  webp_.reset();
  if (!problem) return {with(".webp"), note.empty() ? "" : "no film.mp4: " + note};
  return {{}, "no film: " + (note.empty() ? "" : note + "; no film.webp: ") + *problem};
}

// Makes a film of frames that ffmpeg took and lost. After a signal there is no time for it.
FilmMade FilmWriter::made_again(const std::string& problem) {
  WebpFilm& film = begin_webp();
  const auto stopped = [&] { return plan_.patience.stop && plan_.patience.stop(); };
  try {
    for (std::size_t i = 0; i < frames_; ++i) {
      if (stopped()) break;
      film.add(plan_.read(i));
    }
    if (!stopped()) return webp_made(problem);
  } catch (const std::exception&) {  // a frame's file is gone
  }
  webp_.reset();
  return {{}, "no film: " + problem};
}

FilmMade FilmWriter::finish() {
  if (webp_) return webp_made(no_mp4_);
  const std::optional<std::string> problem = mp4_->finish();
  mp4_.reset();
  if (!problem) return {with(".mp4"), ""};
  std::string why = reason(*problem);
  if (frames_ > 0 && plan_.read && may_be_webp()) return made_again(why);
  if (plan_.kind == FilmKind::automatic && !webp_is_built_in())
    why += std::string("; no film.webp: this build has no libwebp (") + kWebpCommand + ")";
  return {{}, "no film: " + why};
}

}  // namespace voxmelt::render
