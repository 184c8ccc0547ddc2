// The streaming pipeline runs under SystemC: a reader, T cascaded time steps, and a writer. Each block has
// one process, and plain two-phase registers inside.
//
//   memory -> reader -> [step t] -> [step t + 1] -> ... -> writer -> memory
//                          ^             ^
//                        feed          feed        (irradiance, where the scene has radiation;
//                                                   in step t also the cells that fall)
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "hwmodel/pipeline/model/configuration.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/memory_ports.h"
#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/pipeline/model/stream_machine.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

class Simulation;

class Pipeline final : public StreamMachine {
 public:
  // `make` makes the stages, which may have planted faults. `simulation` may hold other machines, which go on
  // while a train runs. If it is null, the pipeline has one of its own.
  Pipeline(const rule::Parameters& parameters, state::Grid grid, const Configuration& configuration,
           const StageMaker& make = make_stage, Simulation* simulation = nullptr);
  ~Pipeline() override;
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  // The following serve to plant faults. A null fault plants none.
  std::vector<CellFifo*> channels_behind_stages(int cascade);  // those of one time step
  void plant(PortFault* fault);
  void plant(FeedFault* fault);
  void plant(CodeFault* fault);

  // Runs a train of one pass, over one tile.
  PassEnd run_pass(const Pass& pass, const Irradiance* irradiance, state::Volume& volume);
  std::vector<const Stage*> working_stages() const;  // without the reader, the feeds and the writer

  const Design& design() const override;
  const Configuration& configuration() const override;
  void watch(FifoWatcher<Cell>* watcher) override;
  void watch_columns(ColumnWatcher* watcher) override;
  void watch_feeds(FifoWatcher<UInt<16>>* watcher) override;
  void watch_falls(FifoWatcher<UInt<1>>* watcher) override;
  void each_cycle(std::function<void()> watch) override;
  void memory(StreamMemory* memory) override;
  void poll(std::function<void()> poll) override;
  PassEnd run_train(const Pass& first, const Next& next, const Fed& fed, state::Volume& volume) override;
  const Books& books() const override;
  const state::Volume& written() const override;
  std::vector<ChannelReport> channels() const override;
  std::vector<StageReport> stages() const override;
  std::vector<StageCycles> accounts() const override;

  std::int64_t cycle() const override;
  void stop() override;
  std::vector<TokenChannel> token_channels() const override;
  void probe(ChannelProbe* probe) override;
  std::vector<StageClasses> stage_classes() const override;
  std::vector<std::int64_t> stage_counts() const override;

 private:
  struct Machine;
  std::unique_ptr<Simulation> own_;  // null: the simulation belongs to the caller
  Simulation& simulation_;
  std::unique_ptr<Machine> machine_;
};

}  // namespace voxmelt::hwmodel
