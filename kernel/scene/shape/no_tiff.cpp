// Stands for tiff_heights.cpp in a build without libtiff.
#include <filesystem>

#include "kernel/scene/shape/heightfield.h"

namespace voxmelt::scene {

bool tiff_is_built_in() { return false; }

Elevation read_tiff_heights(const std::filesystem::path& file, const Place& place) {
  fail_at(place, file.string() +
                     ": this build has no libtiff: apt-get install libtiff-dev, then configure and build "
                     "again; or `gdal_translate -of AAIGrid` converts it");
}

}  // namespace voxmelt::scene
