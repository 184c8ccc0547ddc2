#include "app/shrink.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/interrupt.h"
#include "app/shell_word.h"
#include "hwmodel/pipeline/check/shrink.h"
#include "kernel/run/io/export.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/io/unfinished.h"
#include "kernel/scene/excerpt.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;
using hwmodel::Case;
using hwmodel::Mismatch;

std::vector<std::string> overrides_of(const Common& common) {
  std::vector<std::string> sets = common.sets;
  if (common.seed) sets.push_back(fmt::format("run.seed={}", *common.seed));
  return sets;
}

// Without "step 3: " of a channel: a machine with fewer time steps has other numbers.
std::string stage_of(const std::string& where) {
  const std::size_t colon = where.find(": ");
  return where.starts_with("step ") && colon != std::string::npos ? where.substr(colon + 2) : where;
}

// A folder of this process that goes away with it.
class Workplace {
 public:
  explicit Workplace(const fs::path& beside) : folder_(beside.string() + ".partial") {
    const auto held = io::changing_places();
    fs::create_directories(folder_);
    unfinished_.begin([this] { remove(); });
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  ~Workplace() {
    const auto held = io::changing_places();
    remove();
  }
  const fs::path& folder() const { return folder_; }

 private:
  void remove() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path folder_;
  io::Unfinished unfinished_;
};

class Search {
 public:
  Search(const ShrinkRequest& request, const hwmodel::VerifyReport& report)
      : request_(request),
        report_(report),
        excerpt_(request.scene.file, overrides_of(request.common)),
        fast_(find_implementation(request.common)),
        workplace_(fields_folder(request.file)) {}

  std::vector<std::string> removable() const { return excerpt_.removable(); }

  std::string text_of(const Case& one, const std::string& fields) const {
    return excerpt_.text({one.from, one.size(), one.without}, fields, one.first_step);
  }

  // Every case is written and loaded as its user will do it. So what is left in the end can be seen again.
  bool fails(const Case& one) {
    stop_if_interrupted();
    const fs::path& folder = workplace_.folder();
    std::unique_ptr<scene::Scene> scene;
    try {
      io::export_npy(one.volume, folder);
      io::write_file(folder / "scene.toml", text_of(one, "."));
      scene = std::make_unique<scene::Scene>(scene::load(folder / "scene.toml", {}));
    } catch (const scene::InputError&) {
      return false;  // this part is no scene of its own
    }
    hwmodel::VerifyOptions options = request_.options;
    options.steps = one.steps;
    options.every = 1;
    options.configuration = one.configuration;
    options.fault_step = one.first_step;
    options.timeline = options.waves = false;
    const hwmodel::VerifyReport again =
        hwmodel::verify(scene->parameters, scene->initial, one.first_step, fast_, {}, options);
    if (again.mismatch == nullptr) return false;
    const Mismatch &was = *report_.mismatch, &is = *again.mismatch;
    if (is.kind != was.kind || stage_of(is.where) != stage_of(was.where)) return false;
    if (report_.found_where_planted() && !again.found_where_planted()) return false;
    return true;
  }

 private:
  const ShrinkRequest& request_;
  const hwmodel::VerifyReport& report_;
  const scene::Excerpt excerpt_;
  const step::Implementation& fast_;
  Workplace workplace_;
};

// The state before the step that differs: one step shows it. If it does not, the state from which all of it
// can be seen again.
std::optional<Case> first_case(const ShrinkRequest& request, const hwmodel::VerifyReport& report,
                               Search& search) {
  Case one{*report.replay,
           {},
           report.replay_step,
           report.pass_end - report.replay_step,
           request.options.configuration,
           {}};
  run::Simulation simulation(request.scene.parameters, one.volume, find_implementation(request.common), {});
  simulation.begin_at(one.first_step);
  const std::uint32_t step = report.mismatch->step;
  while (simulation.step_number() < step) simulation.step();
  Case late = one;
  late.volume = simulation.volume();
  late.first_step = step, late.steps = 1;
  if (search.fails(late)) return late;
  late.steps = 2;
  if (search.fails(late)) return late;
  if (search.fails(one)) return one;
  return {};
}

std::string machine_text(const hwmodel::Configuration& is) {
  const hwmodel::Configuration usual;
  std::string text;
  const auto add = [&](const char* key, auto value, auto standard) {
    if (value != standard) text += fmt::format(" --set hw.{}={}", key, value);
  };
  add("lanes", is.lanes, usual.lanes);
  add("cascade", is.cascade, usual.cascade);
  add("substeps", is.substeps, usual.substeps);
  add("fifo_depth", is.fifo_depth, usual.fifo_depth);
  add("stall_seed", is.stall_seed, usual.stall_seed);
  add("overlap", is.overlap ? 1 : 0, usual.overlap ? 1 : 0);
  add("tile", is.tile, usual.tile);
  add("coded", is.coded ? 1 : 0, usual.coded ? 1 : 0);
  return text;
}

int cells_with_something(const state::Volume& volume) {
  int cells = 0;
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y < volume.grid.y; ++y)
      for (int x = 0; x < volume.grid.x; ++x)
        cells += volume.solid.test(x, y, z) || volume.liquid.test(x, y, z) || volume.inert.test(x, y, z);
  return cells;
}

}  // namespace

std::string fields_folder(const std::string& file) {
  fs::path folder(file);
  folder.replace_extension();
  return folder.string() + "_fields";
}

std::string shrink(const ShrinkRequest& request, const hwmodel::VerifyReport& report) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(request.seconds));
  Search search(request, report);
  std::optional<Case> first = first_case(request, report, search);
  if (!first)
    return "--shrink: the difference is not seen again from the state before it; nothing was written\n";
  const Mismatch& m = *report.mismatch;
  hwmodel::Shrinker shrinker(
      std::move(*first), search.removable(), [&](const Case& one) { return search.fails(one); },
      [&] { return Clock::now() < end; });
  const Case& small = shrinker.shrink({m.x, m.y, m.z});

  const fs::path folder = fields_folder(request.file);
  io::OutputFolder fields(folder);
  io::export_npy(small.volume, fields.partial());
  fields.commit();
  std::string typed = fmt::format("voxmelt verify {} --steps {}", shell_word(request.file), small.steps) +
                      machine_text(small.configuration);
  if (request.common.implementation != "auto") typed += " --implementation " + request.common.implementation;
  if (!request.plant.empty())
    typed += fmt::format(" --plant {} --plant-step {}", request.plant, small.first_step);
  io::write_file(
      request.file,
      fmt::format("# A hardware model that differs from the software ({}), made small.\n#   {}\n{}",
                  stage_of(m.where), typed, search.text_of(small, folder.filename().string())));
  const std::array<int, 3> size = small.size();
  return fmt::format(
      "{} holds {} x {} x {} cells, {} of them not air, which fail in {} step{} ({} runs were tried); "
      "to see it:\n  {}\n",
      request.file, size[0], size[1], size[2], cells_with_something(small.volume), small.steps,
      small.steps == 1 ? "" : "s", shrinker.tried(), typed);
}

}  // namespace voxmelt::app
