// What `voxmelt list` prints of what this program has.
#pragma once

namespace voxmelt::app {

void list_implementations();
void list_scenes();
void list_features();

}  // namespace voxmelt::app
