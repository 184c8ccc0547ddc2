#include "library/journal/timeline.h"

#include "voxmelt/errors.h"

namespace voxmelt::journal {

std::vector<Line> timeline_of(const scene::Scene& scene) {
  std::vector<Line> lines;
  for (const scene::Change& change : scene.changes) {
    if (change.step < scene.first_step) continue;
    try {
      lines.push_back({change.step - scene.first_step, read_change(change.what), change.place});
    } catch (const InputError& wrong) {
      throw InputError(change.place + ": " + wrong.what());
    }
  }
  return lines;
}

}  // namespace voxmelt::journal
