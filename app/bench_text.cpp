#include "app/bench_text.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "app/interrupt.h"
#include "app/print.h"
#include "measure/texts.h"

namespace voxmelt::app {
namespace {

using measure::Case;
using measure::milliseconds;
using measure::Subject;
using measure::three_digits;

void done() {
  std::fflush(stdout);
  stop_if_interrupted();
}

void print_case(const Case& one) {
  const auto phase = [&](step::Phase p) { return measure::milliseconds(one.step.phase[index_of(p)]); };
  using enum step::Phase;
  const std::string phases = one.subject == Subject::flow
                                 ? fmt::format("{} + {} + {}", phase(gravity), phase(spread), phase(excess))
                                 : fmt::format("{} + {}", phase(heat), phase(melt));
  print("  {:<5} {:<9} {:>7}  {:>8} {:>8}  {:<22} {:>8.0f} {:>8.0f} {:>8} {:>6} {:>6} {:>8} {:>8} {:>6}\n",
        measure::name_of(one.subject), one.implementation, one.threads, measure::milliseconds(one.seconds),
        measure::milliseconds(one.median_seconds), phases, one.cells_per_second() / 1e6,
        one.active_per_second() / 1e6, measure::three_digits(1e9 / one.active_per_second()),
        one.bytes_per_cell, measure::or_dash(one.percent_of_roof()), measure::or_dash(one.ratio_to_baseline),
        measure::or_dash(one.ratio_to_native), one.rounds);
}

}  // namespace

void print_case_heading() {
  print("{:<25}{:>8} {:>8}  {:<22} {:>8} {:>8} {:>8} {:>6} {:>6} {:>8} {:>8}\n", "", "ms per", "median",
        "gravity+spread+excess", "Mcells/s", "Mcells/s", "ns per", "bytes", "% of", "times", "times");
  print("  {:<5} {:<9} {:>7}  {:>8} {:>8}  {:<22} {:>8} {:>8} {:>8} {:>6} {:>6} {:>8} {:>8} {:>6}\n", "",
        "by", "threads", "step", "round", "or heat+melt", "grid", "active", "active", "/cell", "roof",
        "baseline", "native", "rounds");
}

void print_workload(const measure::Workload& workload, const measure::Result& result,
                    const std::vector<Case>& cases) {
  const state::Grid g = workload.start.grid;
  print("{}  {} x {} x {}, {:.1f} % liquid", workload.name, g.x, g.y, g.z,
        100 * static_cast<double>(workload.start.liquid.count()) / static_cast<double>(g.cells()));
  const auto print_baseline = [&](Subject subject) {
    const auto ms = [&](const measure::Seconds& step) {
      return measure::milliseconds(measure::seconds_of(subject, step));
    };
    if (result.plain) print("; {} of the baseline {} ms", measure::name_of(subject), ms(*result.plain));
    if (result.native) print(", native {} ms", ms(*result.native));
  };
  if (workload.times_flow) print_baseline(Subject::flow);
  if (workload.times_heat) print_baseline(Subject::heat);
  print("; checked against {}\n", workload.judge);
  for (const Case& one : cases) print_case(one);
  done();
}

void print_drawing(const measure::Drawing& drawing) {
  print("{}  pictures of {} x {}, ms; a PNG file {}; checked against the plain painter\n", drawing.workload,
        measure::kPictureSide, measure::kPictureSide, milliseconds(drawing.encode));
  print("  {:<7} {:<7} {:>7} {:>7} {:>9} {:>9} {:>7} {:>7} {:>7} {:>10} {:>6}\n", "", "by", "threads",
        "field", "light etc", "unchanged", "fast", "normal", "best", "ns per ray", "rounds");
  for (const measure::DrawingTiming& one : drawing.timings)
    print("  {:<7} {:<7} {:>7} {:>7} {:>9} {:>9} {:>7} {:>7} {:>7} {:>10} {:>6}\n", "picture",
          cpu::name_of(one.set), one.threads, milliseconds(one.field), milliseconds(one.light),
          milliseconds(one.unchanged), milliseconds(one.draw[0]), milliseconds(one.draw[1]),
          milliseconds(one.draw[2]), three_digits(drawing.nanoseconds_per_ray(one, 0)), drawing.rounds);
  done();
}

void print_finer_grids(const std::vector<measure::FinerGrid>& grids) {
  print("finer grids, pictures of {} x {}, one thread, ms\n", measure::kPictureSide, measure::kPictureSide);
  for (std::size_t i = 0; i < grids.size(); ++i)
    for (std::size_t t = 0; t < grids[i].timings.size(); ++t) {
      const measure::FinerGrid::Timing& one = grids[i].timings[t];
      print("  {:<30} {:>4} x {:>3} x {:>4}  {:<7} fast {:>6}, normal {:>6}, times the grid before: {}\n",
            grids[i].scene, grids[i].grid.x, grids[i].grid.y, grids[i].grid.z, cpu::name_of(one.set),
            milliseconds(one.fast), milliseconds(one.normal),
            measure::or_dash(measure::growth_of_normal(grids, i, t)));
    }
  done();
}

void print_device_case(const measure::DeviceMachine& machine, const measure::DeviceCase& one) {
  print("{}  {} x {} x {} on {} ({}); checked against {}\n", one.workload, one.grid.x, one.grid.y, one.grid.z,
        machine.implementation, machine.name, one.judge);
  print("  a step {} ms, {} Mcells/s active; {} % of what it copies ({} GB/s), {} launches are {} %\n",
        milliseconds(one.seconds), three_digits(static_cast<double>(one.active) / one.seconds / 1e6),
        three_digits(one.percent_of_copy()), three_digits(machine.copy / 1e9), three_digits(one.launches),
        three_digits(one.percent_of_launches()));
  print("  {} with {} {} ms: {} times as long; in a run, with visibility, a step takes {} ms\n",
        one.processor.implementation->name, measure::threads_text(one.processor.threads),
        milliseconds(one.processor_seconds), three_digits(one.times_processor()), milliseconds(one.as_run));
  for (const auto& [what, transfer] :
       {std::pair{"state there", one.upload}, {"masks back", one.masks}, {"state back", one.download}})
    print("  {:<14} {:>8} ms  {:>8} MB\n", what, milliseconds(transfer.seconds),
          three_digits(static_cast<double>(transfer.bytes) / 1e6));
  if (one.rays > 0)
    print("  {:<14} {:>8} ms  for {} rays, where it is a step of visibility\n", "visibility",
          milliseconds(one.visibility), one.rays);
  if (one.picture)
    print("  {:<14} {:>8} ms  {} x {}, {} of it to draw, {} launches; a processor makes it in {} ms\n",
          "picture", milliseconds(one.picture->seconds()), one.picture->width, one.picture->height,
          milliseconds(one.picture->draw), one.picture->launches, milliseconds(one.picture->processor));
  for (const measure::KernelTime& kernel : one.kernels)
    print("  {:<14} {:>8} ms  in {} calls\n", kernel.name, milliseconds(kernel.seconds),
          three_digits(kernel.calls));
  done();
}

void print_film(const measure::MeltFilm& film) {
  print("a whole melt  {:<10} {} steps in {} frames, {}: {} frames a second, {} ms of processor a frame\n",
        film.scene, film.steps, film.frames, measure::threads_text(film.threads),
        three_digits(film.frames_per_second()), milliseconds(film.processor_seconds / film.frames));
  done();
}

}  // namespace voxmelt::app
