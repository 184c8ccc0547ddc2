#include "hwmodel/explore/schedule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include "hwmodel/memory/ratio.h"
#include "hwmodel/pipeline/model/lag.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/column_port.h"
#include "hwmodel/pipeline/time/prediction.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Counts the time steps of the pass that begins with `step`. None reaches beyond a step of visibility.
int steps_of_pass(const Design& design, const Configuration& c, std::uint32_t step, std::int64_t left) {
  const rule::Heat& heat = design.parameters.heat;
  std::int64_t steps = std::min<std::int64_t>(left, host_sees_each_step(design.parameters) ? 1 : c.cascade);
  if (heat.radiates())
    steps = std::min<std::int64_t>(steps, heat.visibility_every - heat.visibility_age(step));
  return static_cast<int>(steps);
}

// Counts the bits of the state in some blocks along x. Columns of tiles, and coded ones, are whole bursts.
std::int64_t state_bits(const Design& design, bool coded, const Content& content, int first, int end) {
  if (coded) return Content::between(content.coded_before, first, end);
  const Shape& shape = design.shape;
  const std::int64_t column = shape.column() * shape.lanes * design.cell_bits();
  return std::int64_t{end - first} * shape.grid.z * (shape.tiled() ? CodeLayout::up(column) : column);
}

// Adds one tile of a pass to a train.
void add_pass(Train& train, const Design& design, const Configuration& c, const Pass& pass,
              const Content& content) {
  const Shape& shape = design.shape;
  const int first = shape.first_block(pass.tile), end = first + shape.blocks();
  ++train.passes;
  train.list.push_back(pass);
  train.work.tokens += shape.tokens();
  train.work.read_bits += state_bits(design, c.coded, content, first, end);
  train.work.written_bits +=
      state_bits(design, c.coded, content, shape.owned_begin(pass.tile), shape.owned_end(pass.tile));
  if (design.hot() && design.parameters.heat.radiation && pass.begins())
    train.work.fed_bits +=
        pass.steps *
        (shape.tiled() ? Content::between(content.irradiance_before, first, end) : content.irradiance_bits);
  if (pass.uses(StageKind::fall, 0)) train.work.fed_bits += FallStream::bits_of_tile(shape);
}

// Returns the tiles of the passes that are weighed one by one: of many passes the first, the second and the
// last. All others take as long as the second.
std::vector<Pass> weighed(const Train& train, const Shape& shape, ColumnWork& work) {
  const std::int64_t tiles = shape.tiles(), passes = std::ssize(train.list) / tiles;
  if (passes <= 3) return train.list;
  work.repeats = passes - 3;
  work.pass_columns = static_cast<std::size_t>(tiles * shape.blocks() * shape.grid.z);
  std::vector<Pass> list(train.list.begin(), train.list.begin() + 2 * tiles);
  list.insert(list.end(), train.list.end() - tiles, train.list.end());
  return list;
}

// Adds the columns of each tile in the order of the stream. Each one is read, and it is written if the tile
// owns it.
void add_columns(Train& train, const std::vector<Pass>& list, const Design& design, const Configuration& c,
                 const Content& content) {
  const Shape& shape = design.shape;
  const double all = ratio(state_bits(design, false, content, 0, 1), shape.grid.z);
  for (const Pass& pass : list) {
    const int first = shape.first_block(pass.tile);
    for (int z = 0; z < shape.grid.z; ++z)
      for (int block = first; block < first + shape.blocks(); ++block) {
        const std::size_t at = z * shape.grid_blocks() + block;
        const double bursts = c.coded ? content.coded_columns[at] : all / CodeLayout::kBurstBits;
        const bool owned = shape.owns(pass.tile, block * shape.lanes);
        train.placement.work.columns.push_back({bursts, owned ? bursts : 0});
      }
  }
}

// Returns how many columns after the reader each time step takes irradiance.
std::vector<std::size_t> feed_delays(const Train& train, const Design& design, const Configuration& c) {
  const Pass& pass = train.list.front();
  const std::int64_t tokens = design.shape.tokens();
  std::int64_t step = 0, before = 1;  // cycles of a step, and of its stages before the exchange
  bool reached = false;
  for (const StageKind stage : stages_of_step(design)) {
    reached |= stage == StageKind::exchange;
    const std::int64_t lag = lag_of(stage, design).tokens(design.shape) + registers_of(stage, design);
    const std::int64_t wait =
        1 + (lag < tokens ? c.interval() * lag : c.interval() * (tokens - 1) + lag - tokens + 1);
    step += wait;
    if (!reached) before += wait;
  }
  std::vector<std::size_t> delays;
  delays.reserve(pass.steps);
  const std::int64_t column = c.interval() * design.shape.column();
  for (int t = 0; t < pass.steps; ++t) delays.push_back(std::llround(ratio(t * step + before, column)));
  return delays;
}

// Adds what a feed fetches: as much as it has used, less what it fetched at the beginning.
void add_feed(ColumnWork& work, const std::vector<double>& used, std::size_t delay) {
  constexpr double kFirst = kBurstsAhead;
  const double all = std::accumulate(used.begin(), used.end(), 0.0);
  const double begin = std::min(all, kFirst);
  work.fed_first.push_back(begin);
  work.fed.resize(std::max(work.fed.size(), used.size() + delay));
  double left = all - begin;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const double fetched = std::min(left, used[i]);
    work.fed[i + delay] += fetched;
    left -= fetched;
  }
}

// Adds what the feeds of irradiance fetch.
void add_feeds(Train& train, const std::vector<Pass>& list, const Design& design, const Configuration& c,
               const Content& content) {
  const Shape& shape = design.shape;
  ColumnWork& work = train.placement.work;
  const std::vector<std::size_t> delays = feed_delays(train, design, c);
  for (int t = 0; t < std::ssize(delays); ++t) {
    std::vector<double> used;
    for (const Pass& pass : list) {
      const int first = shape.first_block(pass.tile);
      for (int z = 0; z < shape.grid.z; ++z)
        for (int block = first; block < first + shape.blocks(); ++block) {
          const std::size_t at = z * shape.grid_blocks() + block;
          const bool works = t < pass.steps;
          used.push_back(works ? ratio(content.lit_columns[at], CodeLayout::kBurstBits) : 0);
        }
    }
    add_feed(work, used, delays[t]);
  }
}

void end_train(Train& train, const Design& design, const Configuration& c, const Content& content) {
  train.work.passes = 1;
  train.work.cycles = predicted_cycles(design, c, train.list.front(), train.passes);
  train.work.lag = train.work.cycles - c.interval() * train.work.tokens;
  const Shape& shape = design.shape;
  const auto falls = std::count_if(train.list.begin(), train.list.end(),
                                   [](const Pass& pass) { return pass.uses(StageKind::fall, 0); });
  const bool lit = train.work.fed_bits > falls * FallStream::bits_of_tile(shape);
  // The writes lie as many columns behind as the lag has. Those of tiles lie in the other copy, and a plane
  // there is as wide as the grid.
  const ColumnSlots slots(design, c.coded);
  const double columns = ratio(train.work.lag, c.interval() * shape.column());
  const double of_grid = columns * shape.grid_blocks() / shape.blocks();
  const double bursts = of_grid * static_cast<double>(slots.slot_bursts);
  const double copy = static_cast<double>(slots.columns * slots.slot_bursts);
  if (shape.tiled())
    train.placement.behind = {{bursts - copy, .5}, {bursts + copy, .5}};
  else if (c.coded)
    train.placement.behind = {{bursts, 1}};
  if (c.coded && content.coded_columns.empty()) return;  // nobody knows the state
  ColumnWork& work = train.placement.work;
  const std::vector<Pass> list = weighed(train, shape, work);
  add_columns(train, list, design, c, content);
  work.coded = c.coded;
  work.slot_bursts = static_cast<double>(slots.slot_bursts);
  work.column_cycles = static_cast<double>(c.interval() * shape.column());
  work.lag = static_cast<double>(train.work.lag);
  if (lit) add_feeds(train, list, design, c, content);
  const double bursts_of_column = ratio(shape.column() * shape.lanes, CodeLayout::kBurstBits);
  if (falls > 0) add_feed(work, std::vector<double>(work.columns.size(), bursts_of_column), 0);
}

// Adds all tiles of a pass to the last train, or to new ones.
void add_tiles(std::vector<Train>& trains, const Design& design, const Configuration& c, Pass pass,
               const Content& content) {
  for (pass.tile = 0; pass.tile < design.shape.tiles(); ++pass.tile) {
    if (pass.tile > 0 && !tiles_follow(design, c, pass)) trains.emplace_back();
    add_pass(trains.back(), design, c, pass, content);
  }
}

// Adds one time step with more sub-steps than the machine has copies of settle and spread, pass after pass.
void add_substeps(std::vector<Train>& trains, const Design& design, const Configuration& c, Pass pass,
                  const Content& content) {
  for (; pass.substep < pass.substeps; pass.substep += pass.count) {
    pass.count = std::min(pass.count, pass.substeps - pass.substep);
    trains.emplace_back();
    add_tiles(trains, design, c, pass, content);
  }
  trains.back().steps = 1;
}

std::vector<Train> lists_of(const Design& design, const Configuration& c, std::uint32_t first_step,
                            std::int64_t steps, const Content& content) {
  const rule::Heat& heat = design.parameters.heat;
  const int substeps = design.paper() ? 1 : design.parameters.flow.viscous.substeps;
  std::vector<Train> trains;
  for (std::int64_t done = 0; done < steps;) {
    Pass pass{.first = first_step + static_cast<std::uint32_t>(done)};
    pass.substeps = substeps == 0 ? content.substeps_of(done, c.substeps) : substeps;
    pass.count = std::min(pass.substeps, c.substeps);
    pass.falls = content.falls;
    if (!pass.ends()) {
      add_substeps(trains, design, c, pass, content);
      ++done;
      continue;
    }
    trains.emplace_back();
    pass.steps = steps_of_pass(design, c, pass.first, steps - done);
    while (true) {
      add_tiles(trains, design, c, pass, content);
      trains.back().steps += pass.steps;
      done += pass.steps;
      const std::uint32_t step = first_step + static_cast<std::uint32_t>(done);
      if (done == steps || substeps == 0 || design.parameters.pieces.fall ||
          !passes_overlap(design, c, pass) || (heat.radiates() && heat.visibility_age(step) == 0))
        break;
      pass.first = step;
      pass.steps = steps_of_pass(design, c, step, steps - done);
    }
  }
  return trains;
}

// Compares two trains in all that a pass takes time by: neither in the number of the first step, nor in the
// number of a sub-step that is not the first nor the last.
bool alike(const Train& a, const Train& b) {
  const auto form = [](const Pass& pass) {
    return std::tuple(pass.steps, pass.begins(), pass.ends(), pass.count, pass.tile, pass.falls);
  };
  return a.steps == b.steps && std::equal(a.list.begin(), a.list.end(), b.list.begin(), b.list.end(),
                                          [&](const Pass& x, const Pass& y) { return form(x) == form(y); });
}

}  // namespace

std::vector<Train> trains_of(const Design& design, const Configuration& c, std::uint32_t first_step,
                             std::int64_t steps, const Content& content) {
  std::vector<Train> trains = lists_of(design, c, first_step, steps, content);
  for (Train& train : trains) end_train(train, design, c, content);
  return trains;
}

std::vector<Train> kinds_of_trains(const Design& design, const Configuration& c, std::uint32_t first_step,
                                   std::int64_t steps, const Content& content) {
  std::vector<Train> kinds;
  for (Train& train : lists_of(design, c, first_step, steps, content)) {
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](const Train& kind) { return alike(kind, train); });
    if (known == kinds.end())
      kinds.push_back(std::move(train));
    else
      ++known->times;
  }
  for (Train& train : kinds) end_train(train, design, c, content);
  return kinds;
}

}  // namespace voxmelt::hwmodel::explore
