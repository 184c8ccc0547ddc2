#include "hwmodel/explore/timing.h"

#include <cstddef>
#include <memory>
#include <optional>

#include "hwmodel/explore/schedule.h"
#include "hwmodel/pipeline/model/lag.h"
#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Takes and gives tokens as a stage does, whatever they hold.
class Delay final : public Stage {
 public:
  Delay(StageKind kind, const Design& design)
      : Stage(kind, design, lag_of(kind, design).tokens(design.shape)),
        fed_(kind == StageKind::exchange && design.hot() && design.parameters.heat.radiation),
        bits_(make_stage(kind, design)->output_bits()) {}
  int output_bits() const override { return bits_; }  // a channel is as wide as behind the stage itself
  void feed(HeatFifo& feed) override { feed_ = fed_ ? &feed : nullptr; }
  void feed_falls(FallFifo& feed) override { falls_ = kind() == StageKind::fall ? &feed : nullptr; }

 private:
  bool side_input_ready() override {
    return (feed_ == nullptr || feed_->valid()) && (falls_ == nullptr || falls_->valid());
  }
  void advance(const Cell* in, Cell* /*out*/) override {
    if (in != nullptr && feed_ != nullptr) feed_->get();
    if (in != nullptr && falls_ != nullptr) falls_->get();
  }

  bool fed_;
  int bits_;
  HeatFifo* feed_ = nullptr;
  FallFifo* falls_ = nullptr;
};

std::size_t token_at(const CodeLayout& layout, const Place& place) {
  return layout.column_of(place) * layout.height() + place.y;
}

// Says which tokens are air, because stages that compute nothing cannot. They are as before the step that
// follows the pass.
class Told final : public CodeFault {
 public:
  Told(const TimedRun& run, const Design& design) : run_(run), layout_(design) {}

  void begin_train(const Train& train) { train_ = &train; }
  void judged(std::int64_t pass, const Place& place, const Cell* /*lanes*/, bool& air) override {
    const Pass& done = train_->list[pass];
    air = !(*run_.stored(done.first + done.steps))[token_at(layout_, place)];
  }
  void stored(std::int64_t, const Place&, const Cell*, std::int64_t&) override {}
  void ended(std::int64_t, const Place&, std::uint64_t*) override {}
  void found(std::int64_t, const Place&, const std::uint64_t*, bool&) override {}

  // Returns a volume whose tokens are stored as they are before this step.
  state::Volume volume(std::uint32_t step, const Shape& shape) const {
    state::Volume volume(shape.grid);
    const StoredTokens& tokens = *run_.stored(step);
    for (int z = 0; z < shape.grid.z; ++z)
      for (int x = 0; x < shape.grid.x; x += shape.lanes)
        for (int y = 0; y < shape.grid.y; ++y)
          volume.solid.set(x, y, z, tokens[token_at(layout_, {x, y, z})]);
    return volume;
  }

 private:
  const TimedRun& run_;
  CodeLayout layout_;
  const Train* train_ = nullptr;
};

}  // namespace

StoredTokens stored_tokens(const Design& design, const state::Volume& volume) {
  CodedState code{CodeLayout(design)};
  code.store(volume);
  StoredTokens stored;
  for (std::int64_t column = 0; column < code.layout().columns(); ++column)
    for (int y = 0; y < code.layout().height(); ++y) stored.push_back(bit_of(code.slot(column), y));
  return stored;
}

Timing timing_of(const TimedRun& run, StreamMemory* memory) {
  Pipeline pipeline(run.parameters, run.grid, run.configuration, [](StageKind kind, const Design& design) {
    return std::make_unique<Delay>(kind, design);
  });
  pipeline.memory(memory);
  pipeline.poll(run.poll);
  state::Volume volume(run.grid);
  const IrradianceStream dark(Irradiance(run.grid), pipeline.design().shape);
  Timing timing;
  Told told(run, pipeline.design());
  if (run.stored) pipeline.plant(&told);
  Content content;
  content.substeps = run.substeps;
  for (Train& train : trains_of(pipeline.design(), run.configuration, run.first_step, run.steps, content)) {
    const std::uint32_t first = train.list.front().first;
    Fed fed(run.irradiance ? run.irradiance(first) : &dark, run.falls ? run.falls(first) : nullptr);
    for (Pass& pass : train.list) pass.falls = fed.falls != nullptr;
    if (run.stored) {
      told.begin_train(train);
      volume = told.volume(first, pipeline.design().shape);
    }
    std::size_t at = 0;
    const auto next = [&]() -> std::optional<Pass> {
      if (++at == train.list.size()) return {};
      return train.list[at];
    };
    const PassEnd end = pipeline.run_train(train.list.front(), next, fed, volume);
    timing.cycles += end.cycles;
    timing.hangs |= end.hangs;
    if (end.hangs) break;
  }
  timing.channels = pipeline.channels();
  return timing;
}

std::vector<std::string> channel_names(const Design& design, const Configuration& c) {
  std::vector<std::string> names;
  const std::vector<StageKind> stages = stages_of_step(design);
  const auto step = [](int t) { return "step " + std::to_string(t) + ": "; };
  names.push_back(step(0) + "reader -> " + std::string(name_of(stages.front())));
  for (int t = 0; t < c.cascade; ++t)
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const bool last = i + 1 == stages.size();
      const StageKind next = !last ? stages[i + 1] : t + 1 == c.cascade ? StageKind::writer : stages.front();
      names.push_back(step(t) + std::string(name_of(stages[i])) + " -> " + std::string(name_of(next)));
    }
  if (design.hot() && design.parameters.heat.radiation)
    for (int t = 0; t < c.cascade; ++t) names.push_back(step(t) + "feed -> exchange");
  if (design.parameters.pieces.fall) names.push_back(step(0) + "feed -> fall");
  return names;
}

}  // namespace voxmelt::hwmodel::explore
