// These functions check how a program describes a picture, and make a camera of it. An image becomes a frame.
#pragma once

#include <string>

#include "kernel/scene/scene.h"
#include "render/image/image.h"
#include "voxmelt/errors.h"
#include "voxmelt/picture.h"

namespace voxmelt::library {

template <class Number>
Number checked(const char* name, Number value, Number lowest, Number highest,
               const std::string& text = "Picture") {
  if (value >= lowest && value <= highest) return value;  // false for a NaN
  throw InputError(text + ": error: " + std::string(name) + " = " + std::to_string(value) + " is outside " +
                   std::to_string(lowest) + ".." + std::to_string(highest));
}

// Returns the camera of the scene with what the picture says in its place.
scene::Camera camera_of(scene::Camera camera, const Picture& picture);

// Returns the alignment of a frame's rows.
int row_alignment_of(const Picture& picture);
Frame frame_of(const render::Image& image, int row_alignment);

}  // namespace voxmelt::library
