// The picture is drawn by packets of rays (docs/picture/definition.md).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>

#include "kernel/engine/cpu/instruction_set.h"
#include "render/image/image.h"
#include "render/packet/picture_data.h"
#include "render/rule/antialias.h"

namespace voxmelt::render {

// These return the packets of an instruction set, and the best that this processor can run.
const Packets& packets_of(cpu::InstructionSet set);
const Packets& best_packets();

// A picture has one sample a pixel, or eight or thirty-two if a pixel differs from a neighbour.
enum class Setting { fast, normal, best };
inline constexpr std::array kSettings{Setting::fast, Setting::normal, Setting::best};
inline constexpr std::array<const char*, kSettings.size()> kSettingNames{"fast", "normal", "best"};
constexpr std::optional<Setting> setting_named(std::string_view name) {
  for (std::size_t i = 0; i < kSettings.size(); ++i)
    if (name == kSettingNames[i]) return kSettings[i];
  return std::nullopt;
}

// Returns the spacing of samples. They are 2^-spacing cells apart on a ray.
constexpr int spacing_of(Setting setting, const picture::View& view) {
  return (setting == Setting::best ? 3 : 2) + view.halvings;
}

// Tells whether all rays' numbers fit the lanes. Otherwise plain_packets() draw the picture, whichever are
// asked for.
bool fits_lanes(const PictureData& data);

// Is thrown once `stop` has returned true. It is asked before each tile, on every thread.
struct Stopped {};
using Stop = std::function<bool()>;
Image draw_picture(const PictureData& data, Setting setting, const Packets& packets, int threads,
                   const Stop& stop = {});

}  // namespace voxmelt::render
