#include "app/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <utility>

#include "app/options.h"
#include "render/image/contact_sheet.h"
#include "render/image/png.h"
#include "render/image/video.h"
#include "render/raycast/draw.h"

namespace voxmelt::app {
namespace {

constexpr std::size_t kSheetFrames = 12;
constexpr int kFramesPerSecond = 12;

// Halves the size: each pixel is the mean of four.
render::Image halved(const render::Image& image) {
  render::Image half(image.width / 2, image.height / 2);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const int sum = image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                        image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c];
        half.at(x, y)[c] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
  return half;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void set_size(scene::Camera& camera, const std::string& size) {
  const char* const end = size.data() + size.size();
  const auto width = std::from_chars(size.data(), end, camera.width);
  const bool separated = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = separated ? std::from_chars(width.ptr + 1, end, camera.height) : width;
  if (!separated || height.ec != std::errc() || height.ptr != end || camera.width < 16 ||
      camera.height < 16 || camera.width > 8192 || camera.height > 8192)
    throw UsageError(fmt::format("--size {}: error: want WIDTHxHEIGHT, each 16 to 8192", size));
}

Film::Film(const scene::Scene& scene, std::filesystem::path folder, int threads)
    : scene_(scene), folder_(std::move(folder)), threads_(threads) {
  std::filesystem::create_directories(folder_ / "frames");
}

std::filesystem::path Film::frame_file(std::size_t frame) const {
  return folder_ / "frames" / fmt::format("frame_{:05d}.png", frame);
}

void Film::add_frame(const state::Volume& volume, std::uint32_t step) {
  const auto begin = std::chrono::steady_clock::now();
  field_.update(volume, scene_.look, scene_.terrain, threads_);
  update_seconds_ += seconds_since(begin);

  const auto drawing = std::chrono::steady_clock::now();
  render::DrawSettings settings;
  settings.threads = threads_;
  const render::Image image =
      render::draw(field_, scene_.camera, scene_.light, scene_.look, scene_.terrain, settings);
  render::write_png(frame_file(labels_.size()), image);
  render_seconds_ += seconds_since(drawing);
  labels_.push_back(fmt::format("step {}", step));
}

std::string Film::finish() {
  // The sheet shows at most kSheetFrames frames, evenly chosen, the first and the last included.
  std::vector<render::Image> frames;
  std::vector<std::string> labels;
  const std::size_t shown = std::min(kSheetFrames, labels_.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const std::size_t i = shown > 1 ? k * (labels_.size() - 1) / (shown - 1) : 0;
    frames.push_back(halved(render::read_png(frame_file(i))));
    labels.push_back(labels_[i]);
  }
  render::SheetStyle style;
  style.columns = shown > 6 ? 4 : 3;
  render::write_png(folder_ / "contact_sheet.png", render::contact_sheet(frames, labels, style));

  // In ffmpeg's pattern a percent sign of the folder's name is doubled. Its message need not name the folder.
  std::string pattern;
  for (const char c : (folder_ / "frames").string())
    pattern += c == '%' ? std::string("%%") : std::string(1, c);
  const std::string problem =
      render::write_video(folder_ / "film.mp4", pattern + "/frame_%05d.png", 0, kFramesPerSecond)
          .value_or("");
  return problem.substr(std::min(problem.size(), problem.find("no film")));
}

}  // namespace voxmelt::app
