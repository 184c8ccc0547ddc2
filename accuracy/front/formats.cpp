// Number formats are compared by the twin, which computes the paper's law in any of them.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/formats/twin.h"
#include "accuracy/front/sweep.h"
#include "kernel/scene/scene.h"

namespace voxmelt::accuracy::front {
namespace {

Curves run_twin(const Subject& subject, const Setting& setting, const scene::Scene& scene) {
  const std::unique_ptr<Twin> twin = make_twin(setting.arithmetic, scene.parameters, scene.initial);
  Curves curves;
  std::uint32_t done = 0;
  for (std::uint32_t i = 1; i <= subject.samples; ++i) {
    for (; done < subject.steps_to(setting, i); ++done) twin->step();
    curves.push_back(sample_of(*twin, subject.scale(setting)));
  }
  return curves;
}

}  // namespace

std::vector<Format> compare_formats(const Subject& subject, Extent extent, const Conditions& conditions) {
  Setting setting = setting_of_formats();
  std::vector<std::string> sets = subject.sets(setting);
  sets.insert(sets.end(), conditions.sets.begin(), conditions.sets.end());
  const scene::Scene scene = scene::load(conditions.scenes / (subject.scene + ".toml"), sets);
  setting.arithmetic = kExact;
  const Curves exact = run_twin(subject, setting, scene);
  std::vector<Format> formats;
  for (const Arithmetic arithmetic : all_arithmetics()) {
    const bool whole = !is_real(arithmetic.number);
    if (arithmetic == kExact ||
        (extent == Extent::quick && whole && arithmetic.rounding != kEngine.rounding &&
         arithmetic.number != kEngine.number))
      continue;
    setting.arithmetic = arithmetic;
    formats.push_back({arithmetic, errors(run_twin(subject, setting, scene), exact).largest(),
                       state_bits(arithmetic.number, scene.parameters)});
  }
  return formats;
}

}  // namespace voxmelt::accuracy::front
