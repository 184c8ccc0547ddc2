#include "app/film.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <system_error>
#include <utility>

#include "app/interrupt.h"
#include "app/options.h"

namespace voxmelt::app {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// After an interrupt, a frame that was begun before has one second (interrupted_for_long).
constexpr double kSlow = 0.5;
constexpr std::size_t kLargePicture = std::size_t{8} << 20;  // bytes of a picture that always counts as slow

std::string label_of(std::uint32_t step) { return fmt::format("step {}", step); }

std::size_t frame_bytes(const scene::Camera& camera) {
  return sizeof(render::Rgb) * camera.width * camera.height;
}

render::Frames::Plan with_frame_bytes(render::Frames::Plan plan, const scene::Camera& camera) {
  plan.frame_bytes = frame_bytes(camera);
  return plan;
}

}  // namespace

void set_size(scene::Camera& camera, const std::string& size) {
  const char* const end = size.data() + size.size();
  const auto width = std::from_chars(size.data(), end, camera.width);
  const bool separated = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = separated ? std::from_chars(width.ptr + 1, end, camera.height) : width;
  if (!separated || height.ec != std::errc() || height.ptr != end || camera.width < 16 ||
      camera.height < 16 || camera.width > scene::kWidestPicture || camera.height > scene::kWidestPicture)
    throw UsageError(
        fmt::format("--size {}: error: want WIDTHxHEIGHT, each 16 to {}", size, scene::kWidestPicture));
}

Option add_setting(Command command, std::string& setting, const std::string& what) {
  return command.option("--setting", setting, what + "samples per pixel: fast 1, normal 1 or 8, best 1 or 32")
      .one_of({render::kSettingNames.begin(), render::kSettingNames.end()})
      .shows_default();
}

render::Setting setting_of(const std::string& name) { return render::setting_named(name).value(); }

Film::Film(const scene::Scene& scene, const std::filesystem::path& folder, const render::Frames::Plan& plan,
           render::Setting setting)
    : scene_(scene),
      threads_(plan.threads),
      setting_(setting),
      frames_(folder, with_frame_bytes(plan, scene.camera)),
      drawing_(plan.threads > 1 ? 1 : 0, 1, [this](Shot& shot) { draw(shot); }) {
  picture_.stop_when(interrupted_for_long);
}

std::optional<render::Image> Film::drawn_on_device(const run::Simulation& simulation) {
  const auto begin = std::chrono::steady_clock::now();
  if (!on_device_.update(simulation.state_on_device(), scene_.look, scene_.light, scene_.terrain)) return {};
  std::optional<render::Image> image = on_device_.draw(scene_.camera, setting_);
  if (image) pressed_ = on_device_.pressed();
  seconds_.on_device += seconds_since(begin);
  return image;
}

void Film::add_frame(const run::Simulation& simulation, std::uint32_t step) {
  const auto waiting = std::chrono::steady_clock::now();
  check();
  drawing_.wait();
  seconds_.wait += seconds_since(waiting);

  pressed_.reset();
  if (std::optional<render::Image> image = drawn_on_device(simulation))
    return drawing_.put({step, std::move(image)});
  const auto begin = std::chrono::steady_clock::now();
  picture_.update(simulation.volume(), scene_.look, scene_.light, scene_.terrain, threads_);
  seconds_.update += seconds_since(begin);
  drawing_.put({step, {}});
}

void Film::keep(const std::vector<std::uint32_t>& steps) {
  for (const std::uint32_t step : steps) frames_.keep(label_of(step));
  steps_ = steps;
}

const std::vector<std::uint32_t>& Film::settle() {
  drawing_.wait();
  frames_.settle();
  return steps_;
}

bool Film::is_slow() const { return slow_ || frame_bytes(scene_.camera) > kLargePicture; }

void Film::draw(Shot& shot) {
  if (shot.image) {
    frames_.add(std::move(*shot.image), label_of(shot.step));
    steps_.push_back(shot.step);
    return;
  }
  const auto begin = std::chrono::steady_clock::now();
  try {
    render::Image image = picture_.draw(scene_.camera, setting_, threads_);
    seconds_.render += seconds_since(begin);
    slow_ = seconds_since(begin) > kSlow;
    frames_.add(std::move(image), label_of(shot.step));
    steps_.push_back(shot.step);
  } catch (const render::Stopped&) {  // an interrupted run keeps the frames that it has
    seconds_.render += seconds_since(begin);
  }
}

void Film::check() {
  frames_.check();
  drawing_.check();
}

render::FilmMade Film::finish() {
  const auto waiting = std::chrono::steady_clock::now();
  drawing_.wait();
  render::FilmMade made = frames_.finish();
  seconds_.wait += seconds_since(waiting);
  return made;
}

RunSeconds Film::seconds() const {
  RunSeconds seconds = seconds_;
  seconds.encode = frames_.encode_seconds();
  return seconds;
}

}  // namespace voxmelt::app
