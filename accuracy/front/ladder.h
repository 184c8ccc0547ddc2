// A ladder has the settings of one axis, from coarse to fine. All else is as usual.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "accuracy/front/subject.h"

namespace voxmelt::accuracy::front {

enum class Axis { step, rays, visibility, viscous, grid, neighbours };
inline constexpr std::array kPickedAxes{Axis::step, Axis::rays, Axis::visibility, Axis::viscous};
const char* name_of(Axis axis);

enum class Extent { quick, full };

struct Ladder {
  Axis axis = Axis::step;
  std::vector<Setting> settings;  // with the usual one, and the reference last
  const Setting& reference() const { return settings.back(); }
};

Setting usual_setting(Extent extent);
Setting setting_of_formats();  // the formats are compared on a small grid

std::vector<Ladder> ladders(const Subject& subject, Extent extent);

// Tells if nothing finer than the reference can be had along this axis, as with shadows that are cast at each
// step. Along other axes the reference is the finest that was run, and has an error that no one has measured.
bool ends_at_reference(Axis axis);

// Writes what a setting chooses along an axis: "step 1/2", "visibility_every = 4".
std::string text_of(Axis axis, const Setting& setting);

// Writes the choices that differ from the usual ones, as a user would set them.
std::string words_of(const Setting& setting);

}  // namespace voxmelt::accuracy::front
