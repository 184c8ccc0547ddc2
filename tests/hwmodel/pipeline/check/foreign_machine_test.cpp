// The checkers know no pipeline: they verify any machine that shows them its tokens. This one stands for a
// simulation of another kind. It hands on the tokens of a pipeline, and can be wrong in one cell.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/pipeline.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

struct Wrong {
  int channel = -1;  // no channel
  std::int64_t ordinal = 0;
  std::size_t lane = 0;
};

class Foreign final : public StreamMachine, FifoWatcher<Cell> {
 public:
  Foreign(const rule::Parameters& parameters, state::Grid grid, const Configuration& configuration,
          const Wrong& wrong)
      : inner_(parameters, grid, configuration), wrong_(wrong) {
    inner_.watch(this);
  }

  const Design& design() const override { return inner_.design(); }
  const Configuration& configuration() const override { return inner_.configuration(); }
  void watch(FifoWatcher<Cell>* watcher) override { watcher_ = watcher; }
  void watch_columns(ColumnWatcher* watcher) override { inner_.watch_columns(watcher); }
  void watch_feeds(FifoWatcher<UInt<16>>* watcher) override { inner_.watch_feeds(watcher); }
  void watch_falls(FifoWatcher<UInt<1>>* watcher) override { inner_.watch_falls(watcher); }
  void each_cycle(std::function<void()> watch) override { inner_.each_cycle(std::move(watch)); }
  void memory(StreamMemory* memory) override { inner_.memory(memory); }
  void poll(std::function<void()> poll) override { inner_.poll(std::move(poll)); }
  PassEnd run_train(const Pass& first, const Next& next, const Fed& fed, state::Volume& volume) override {
    return inner_.run_train(first, next, fed, volume);
  }
  const Books& books() const override { return inner_.books(); }
  const state::Volume& written() const override { return inner_.written(); }
  std::vector<ChannelReport> channels() const override { return inner_.channels(); }
  std::vector<StageReport> stages() const override { return inner_.stages(); }
  std::vector<StageCycles> accounts() const override { return inner_.accounts(); }
  std::int64_t cycle() const override { return inner_.cycle(); }
  void stop() override { inner_.stop(); }
  std::vector<TokenChannel> token_channels() const override { return inner_.token_channels(); }
  void probe(ChannelProbe* probe) override { inner_.probe(probe); }

  void entered(int channel, std::int64_t ordinal, const Cell* lanes) override {
    std::vector<Cell> token(lanes, lanes + inner_.configuration().lanes);
    if (channel == wrong_.channel && ordinal == wrong_.ordinal)
      token[wrong_.lane].amount = token[wrong_.lane].amount == 0 ? 1 : 0;
    watcher_->entered(channel, ordinal, token.data());
  }
  void left(int channel, std::int64_t ordinal, const Cell* lanes) override {
    watcher_->left(channel, ordinal, lanes);
  }

 private:
  Pipeline inner_;
  Wrong wrong_;
  FifoWatcher<Cell>* watcher_ = nullptr;
};

VerifyReport verified(const Start& start, const Wrong& wrong, std::uint32_t steps) {
  VerifyOptions options;
  options.steps = steps;
  options.configuration = {4, 2, 2, 0};
  options.machine = [&] {
    return std::make_unique<Foreign>(start.parameters, start.volume.grid, options.configuration, wrong);
  };
  return verify(start.parameters, start.volume, 0, run::implementations().widest(), {}, options);
}

TEST(ForeignMachine, IsVerifiedLikeThePipeline) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    const Start start = hostile_start(5, law, {8, 5, 3});
    const VerifyReport own = lockstep(start, {4, 2, 2, 0}, 6), foreign = verified(start, {}, 6);
    ASSERT_EQ(foreign.mismatch, nullptr) << text_of(*foreign.mismatch);
    EXPECT_EQ(foreign.steps, 6u);
    EXPECT_GT(foreign.compared_cells, 0);
    EXPECT_EQ(foreign.compared_cells, own.compared_cells);
    EXPECT_EQ(foreign.cycles, own.cycles);
    EXPECT_EQ(foreign.digest, own.digest);
  }
}

// If 8 x 5 x 3 cells come in lanes of 4, token 17 is in column 3: the second of two blocks, z = 1. There it
// has y = 2.
TEST(ForeignMachine, ItsWrongCellIsNamed) {
  const Start start = hostile_start(5, rule::Law::paper, {8, 5, 3});
  const std::vector<ChannelReport> channels =
      Pipeline(start.parameters, start.volume.grid, {4, 2, 2, 0}).channels();
  for (const int channel : {0, 3}) {
    const VerifyReport report = verified(start, {channel, 17, 3}, 4);
    ASSERT_NE(report.mismatch, nullptr);
    const Mismatch& is = *report.mismatch;
    EXPECT_EQ(is.kind, Mismatch::Kind::stage);
    EXPECT_EQ(is.where, name_of(channels[static_cast<std::size_t>(channel)].producer));
    EXPECT_EQ((std::array{is.x, is.y, is.z, is.lane}), (std::array{7, 2, 1, 3}));
    EXPECT_EQ(is.field, "amount");
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
