// Keeps what the rule tells of a surface (render/rule/watch.h), in the terms of the ray caster's tokens.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "hwmodel/caster/model/tokens.h"
#include "render/rule/fixed_point.h"
#include "render/rule/look.h"
#include "render/rule/watch.h"

namespace voxmelt::hwmodel::raycast {

inline Vec vec_of(picture::Vector v) { return {v.x, v.y, v.z}; }
inline picture::Vector vector_of(Vec v) { return {v.x, v.y, v.z}; }

struct Keep {
  Surface& to;

  template <class Value>
  [[gnu::always_inline]] void operator()(picture::Stage stage, std::string_view name,
                                         const Value& value) const {
    using picture::Stage;
    if constexpr (std::is_same_v<Value, picture::Color>) {
      if (stage == Stage::material && name == "diffuse") to.mixture.material.diffuse = value;
      if (stage == Stage::material && name == "mirror") to.mixture.material.mirror = value;
      if (stage == Stage::material && name == "highlight") to.mixture.material.highlight = value;
      if (stage == Stage::material && name == "emission") to.mixture.emission = value;
      if (stage == Stage::arriving && name == "arriving") to.arriving.light = value;
      if (stage == Stage::mirror && name == "around") to.mirrored.around = value;
      if (stage == Stage::colour && name == "colour") to.sum = value;
    } else if constexpr (std::is_same_v<Value, picture::Vector>) {
      if (stage == Stage::mirror && name == "r") to.mirrored.reflected = vec_of(value);
    } else if constexpr (std::is_integral_v<Value>) {
      const auto narrow = static_cast<std::int32_t>(value);
      if (stage == Stage::material && name == "l") to.mixture.l = narrow;
      if (stage == Stage::material && name == "w") to.mixture.w = narrow;
      if (stage == Stage::material && name == "gloss") to.mixture.material.gloss = narrow;
      if (stage == Stage::arriving && name == "lamp") to.arriving.lamp = value;
      if (stage == Stage::arriving && name == "facing") to.arriving.facing = value;
      if (stage == Stage::arriving && name == "lit") to.arriving.lit = value;
      if (stage == Stage::mirror && name == "peak") to.mirrored.peak = value;
      if (stage == Stage::mirror && name == "eye") to.mirrored.eye = value;
      if (stage == Stage::mirror && name == "more") to.mirrored.more = value;
      if (stage == Stage::mirror && name == "free") to.mirrored.free = value;
    }
  }
};

}  // namespace voxmelt::hwmodel::raycast
