// A box that melts on a floor: a scene without its law, for targets that change a world while it steps.
#pragma once

namespace voxmelt::fuzz {

constexpr const char* kSmallWorld = R"(title = "small"
[grid]
size = [9, 8, 7]
[[solid]]
shape = "box"
size = [4, 4, 4]
at = [4, 4, 4]
temperature = 0.49
[[inert]]
shape = "floor"
thickness = 1
[material]
melting_point = 0.5
[heat]
gamma = 0.15
[[heat_source]]
at = [9, 9, 9]
power = 9
)";

}  // namespace voxmelt::fuzz
