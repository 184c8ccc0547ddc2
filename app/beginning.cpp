#include "app/beginning.h"

#include <fmt/format.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/io/export.h"
#include "kernel/run/opening/checkpoint_scene.h"

namespace voxmelt::app {
namespace {

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// Tells if both scenes agree in all that the rules depend on.
bool is_same(const scene::Scene& a, const scene::Scene& b) {
  const auto text = [](const scene::Scene& scene) {
    return io::parameters_json(scene.parameters, scene.initial.grid, scene.first_step);
  };
  return a.initial_digest == b.initial_digest && text(a) == text(b);
}

}  // namespace

bool names_a_file(const std::string& from) { return !from.empty() && !is_number(from); }

std::uint32_t steps_of(const std::string& from) {
  std::uint32_t steps = 0;
  const auto [end, error] = std::from_chars(from.data(), from.data() + from.size(), steps);
  if (from.empty() || error != std::errc() || end != from.data() + from.size())
    throw UsageError(fmt::format("error: --from {}: neither a step nor a checkpoint", from));
  return steps;
}

Beginning begin_from(const Common& common, const std::string& from) {
  Beginning begin;
  if (names_a_file(from)) {
    if (!run::is_checkpoint(from)) steps_of(from);  // throws, and says what `from` is not
    scene::Scene at = run::scene_of(checkpoint::read(from), from);
    begin.scene = load_scene(common);
    if (begin.scene.mid_run)
      throw UsageError(fmt::format("error: --from {}: {} is a checkpoint itself", from, common.scene));
    if (!is_same(begin.scene, at))
      throw UsageError(fmt::format("error: --from {}: is of another scene than {}, or with other options",
                                   from, common.scene));
    begin.scene.initial = std::move(at.initial);
    begin.scene.mid_run = std::move(at.mid_run);
    begin.scene.files.emplace_back(from);
  } else {
    begin.steps = steps_of(from);
    begin.scene = load_scene(common);
    check_steps(begin.scene, begin.steps);
  }
  if (begin.scene.mid_run && begin.steps == 0) begin.steps = begin.scene.mid_run->steps_done;
  return begin;
}

void check_steps(const scene::Scene& scene, std::uint32_t steps) {
  if (steps > UINT32_MAX - scene.first_step)
    throw UsageError(fmt::format("error: {} steps from step {}: step numbers end at {}", steps,
                                 scene.first_step, UINT32_MAX));
  if (steps == 0 || !scene.mid_run || steps >= scene.mid_run->steps_done) return;
  throw UsageError(fmt::format("error: step {}: the checkpoint of {} is at step {} already", steps,
                               scene.name, scene.mid_run->steps_done));
}

}  // namespace voxmelt::app
