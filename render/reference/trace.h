// The trace tells all numbers by which the reference draws, in the order in which they come about
// (docs/picture/trace.md).
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/image/image.h"
#include "render/reference/picture_scene.h"
#include "render/reference/reference_picture.h"
#include "render/rule/camera.h"
#include "render/rule/watch.h"

namespace voxmelt::render {

class Listener {
 public:
  // Is called with each number or group of numbers. Values from a memory have the name "fetched". Their cell
  // comes first, and then the value.
  virtual void told(picture::Stage stage, std::string_view name, std::span<const std::int64_t> numbers) = 0;

 protected:
  ~Listener() = default;
};

std::string_view name_of(picture::Stage stage);

// Draws the same picture as reference_picture(scene, camera, setting).
Image reference_picture(const PictureScene& scene, const picture::Camera& camera, Setting setting,
                        Listener& listener);
// Draws one pixel of it. Only numbers computed for its own sake are told, and those of its neighbours are
// not.
Rgb reference_pixel(const PictureScene& scene, const picture::Camera& camera, Setting setting, std::int64_t x,
                    std::int64_t y, Listener& listener);

// Writes the trace as lines of text, each with stage, name and numbers. Values that a sample, a normal or a
// light fetches, and its rows, come in one line.
class TraceText : public Listener {
 public:
  explicit TraceText(std::ostream& out) : out_(out) {}
  TraceText(const TraceText&) = delete;
  TraceText& operator=(const TraceText&) = delete;
  virtual ~TraceText() { flush(); }

  void told(picture::Stage stage, std::string_view name, std::span<const std::int64_t> numbers) override;

 private:
  struct Line {
    std::string name, numbers;
  };
  void flush();

  std::ostream& out_;
  picture::Stage stage_ = picture::Stage::pixel;
  std::vector<Line> lines_;
};

}  // namespace voxmelt::render
