#include "hwmodel/pipeline/check/shrink_scene.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "hwmodel/check/shrink/small_scene.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/excerpt.h"

namespace voxmelt::hwmodel {
namespace {

// Removes "step 3: " from the name of a channel, because a machine with fewer time steps has other numbers.
std::string stage_of(const std::string& where) {
  const std::size_t colon = where.find(": ");
  return where.starts_with("step ") && colon != std::string::npos ? where.substr(colon + 2) : where;
}

class Search {
 public:
  Search(const ShrinkRequest& request, const VerifyReport& report)
      : request_(request),
        report_(report),
        excerpt_(request.scene.file, request.overrides),
        workplace_(request.fields) {}

  std::vector<std::string> removable() const { return excerpt_.removable(); }

  std::string text_of(const Case& one, const std::string& fields) const {
    return excerpt_.text({one.from, one.size(), one.without}, fields, one.first_step);
  }

  bool fails(const Case& one) {
    if (request_.poll) request_.poll();
    const std::unique_ptr<scene::Scene> scene = workplace_.load(one.volume, text_of(one, "."));
    if (scene == nullptr) return false;
    VerifyOptions options = request_.options;
    options.steps = one.steps;
    options.every = 1;
    options.configuration = one.configuration;
    options.fault_step = one.first_step;
    options.timeline = options.waves = false;
    const VerifyReport again =
        verify(scene->parameters, scene->initial, one.first_step, request_.fast, {}, options);
    if (again.mismatch == nullptr) return false;
    const Mismatch &was = *report_.mismatch, &is = *again.mismatch;
    if (is.kind != was.kind || stage_of(is.where) != stage_of(was.where)) return false;
    if (report_.found_where_planted() && !again.found_where_planted()) return false;
    return true;
  }

 private:
  const ShrinkRequest& request_;
  const VerifyReport& report_;
  const scene::Excerpt excerpt_;
  const check::Workplace workplace_;
};

// Returns the state before the step that differs, if one or two steps show the mismatch. Otherwise returns
// the state from which all of it can be seen again.
std::optional<Case> first_case(const ShrinkRequest& request, const VerifyReport& report, Search& search) {
  Case one{*report.replay,
           {},
           report.replay_step,
           report.pass_end - report.replay_step,
           request.options.configuration,
           {}};
  run::Simulation simulation(request.scene.parameters, one.volume, request.fast, {});
  simulation.begin_at(one.first_step);
  const std::uint32_t step = report.mismatch->step;
  while (simulation.step_number() < step) simulation.step();
  Case late = one;
  late.volume = simulation.volume();
  late.first_step = step;
  late.steps = 1;
  if (search.fails(late)) return late;
  late.steps = 2;
  if (search.fails(late)) return late;
  if (search.fails(one)) return one;
  return {};
}

}  // namespace

std::optional<SmallScene> shrink_to_scene(const ShrinkRequest& request, const VerifyReport& report) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(request.seconds));
  Search search(request, report);
  std::optional<Case> first = first_case(request, report, search);
  if (!first) return {};
  const Mismatch& m = *report.mismatch;
  Shrinker shrinker(
      std::move(*first), search.removable(), [&](const Case& one) { return search.fails(one); },
      [&] { return Clock::now() < end; });
  const Case& small = shrinker.shrink({m.x, m.y, m.z});
  return SmallScene{small, check::count_matter(small.volume), shrinker.tried(), stage_of(m.where),
                    search.text_of(small, request.fields.filename().string())};
}

}  // namespace voxmelt::hwmodel
