// The functions here print the lists of `voxmelt list` that this program has.
#pragma once

namespace voxmelt::app {

void list_implementations();
void list_scenes();
void list_features();

}  // namespace voxmelt::app
