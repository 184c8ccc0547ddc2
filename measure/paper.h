// Table 1 of the paper gives milliseconds of a frame, on a Pentium IV of 2.53 GHz.
#pragma once

namespace voxmelt::measure {

struct PaperRow {
  const char* scene;  // name of voxmelt's scene
  const char* as;     // its name in the paper
  double gravity, spreading, update;

  double frames() const { return 1000 / (gravity + spreading + update); }  // frames a second
};
inline constexpr PaperRow kPaperTable[] = {{"cello", "Cello", 3.2, 15.6, 65.8},
                                           {"goblet", "Chocolate", 3.2, 18.4, 83.8},
                                           {"lava", "Lava", 3.2, 21.6, 90.2}};

}  // namespace voxmelt::measure
