#include "render/frames/frames.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "render/image/png.h"

namespace voxmelt::render {
namespace {

// Returns how many frames may wait for an encoder, wait for the film, and be in work.
constexpr std::size_t kMostAhead = 4, kBytesAhead = std::size_t{64} << 20;
std::size_t ahead(const Frames::Plan& plan) {
  return std::clamp<std::size_t>(kBytesAhead / std::max<std::size_t>(plan.frame_bytes, 1), 1, kMostAhead);
}

int encoders(const Frames::Plan& plan) {
  return plan.threads > 1 ? std::min(plan.threads, static_cast<int>(ahead(plan))) : 0;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Frames::Frames(std::filesystem::path folder, const Plan& plan)
    : folder_(std::move(folder)),
      has_film_(plan.film),
      sheet_(plan.count),
      video_(folder_ / "film", {.kind = plan.kind,
                                .frames_per_second = plan.frames_per_second,
                                .patience = {.stop = plan.stop},
                                .read = [this](std::size_t frame) { return read_png(file_of(frame)); }}),
      film_(
          plan.threads > 1 ? 1 : 0, ahead(plan),
          [this](Frame& frame) { video_.add(frame.image ? *frame.image : read_png(file_of(frame.number))); }),
      files_(encoders(plan), ahead(plan), [this](Frame& frame) { write_file(frame); }) {
  std::filesystem::create_directories(folder_ / "frames");
}

std::string Frames::file_name(std::size_t frame) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%05zu.png", frame);
  return name;
}

std::filesystem::path Frames::file_of(std::size_t frame) const {
  return folder_ / "frames" / file_name(frame);
}

void Frames::add(Image image, std::string label) {
  const Frame frame{labels_.size(), std::make_shared<const Image>(std::move(image))};
  files_.put(frame);
  if (has_film_) film_.put(frame);
  labels_.push_back(std::move(label));
}

void Frames::keep(std::string label) {
  if (has_film_) film_.put({labels_.size(), nullptr});
  labels_.push_back(std::move(label));
}

void Frames::write_file(const Frame& frame) {
  const auto begin = std::chrono::steady_clock::now();
  write_png(file_of(frame.number), *frame.image);
  sheet_.offer(frame.number, *frame.image);
  const double seconds = seconds_since(begin);
  const std::lock_guard lock(mutex_);
  encode_seconds_ += seconds;
}

FilmMade Frames::finish() {
  files_.wait();
  film_.wait();
  video_.close();  // ffmpeg can now end beside the sheet
  const auto begin = std::chrono::steady_clock::now();
  if (!labels_.empty())
    write_png(folder_ / "contact_sheet.png",
              sheet_.sheet(labels_, [this](std::size_t frame) { return read_png(file_of(frame)); }));
  encode_seconds_ += seconds_since(begin);

  return has_film_ ? video_.finish() : FilmMade{};
}

}  // namespace voxmelt::render
