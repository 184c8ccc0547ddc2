#include "hwmodel/explore/timing.h"

#include <cstddef>
#include <memory>
#include <optional>

#include "hwmodel/explore/schedule.h"
#include "hwmodel/stream/prediction.h"
#include "hwmodel/stream/stages.h"

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

 private:
  bool side_input_ready() override { return feed_ == nullptr || feed_->valid(); }
  void advance(const Cell* in, Cell* /*out*/) override {
    if (in != nullptr && feed_ != nullptr) feed_->get();
  }

  bool fed_;
  int bits_;
  HeatFifo* feed_ = nullptr;
};

}  // namespace

Timing timing_of(const TimedRun& run, StreamMemory* memory) {
  Pipeline pipeline(run.parameters, run.grid, run.configuration, [](StageKind kind, const Design& design) {
    return std::make_unique<Delay>(kind, design);
  });
  pipeline.memory(memory);
  pipeline.poll(run.poll);
  state::Volume volume(run.grid);
  const IrradianceStream dark(Irradiance(run.grid), pipeline.design().shape);
  Timing timing;
  for (const Train& train : trains_of(pipeline.design(), run.configuration, run.first_step, run.steps)) {
    std::size_t at = 0;
    const auto next = [&]() -> std::optional<Pass> {
      if (++at == train.list.size()) return {};
      return train.list[at];
    };
    const PassEnd end = pipeline.run_train(
        train.list.front(), next, run.irradiance ? run.irradiance(train.list.front().first) : &dark, volume);
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
  return names;
}

}  // namespace voxmelt::hwmodel::explore
