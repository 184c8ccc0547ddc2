// Watches every token of the pipeline. Behind each stage, and behind the reader, it must equal the
// reference's, side bands included. Lanes beyond the grid must hold the border. What leaves a channel must be
// what entered it. The first difference stops the pass.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "hwmodel/lockstep/expectation.h"
#include "hwmodel/lockstep/mismatch.h"
#include "hwmodel/stream/pipeline.h"

namespace voxmelt::hwmodel {

class Checker final : public FifoWatcher<Cell> {
 public:
  explicit Checker(Pipeline& pipeline);

  // What a pass has to give: `steps` has an entry per cascaded step; an empty one is not compared. `written`
  // is what it leaves in memory; null: not compared.
  struct Wanted {
    std::uint32_t first_step = 0;
    std::vector<std::vector<Expected>> steps;
    std::shared_ptr<const state::Volume> written;
  };
  // Unless it stops the pass at the first difference, somebody else must.
  void stop_at_difference(bool stops) { stops_ = stops; }
  void begin_train();
  void add_pass(Wanted wanted);

  void entered(int channel, std::int64_t ordinal, const Cell* lanes) override;
  void left(int channel, std::int64_t ordinal, const Cell* lanes) override;

  const std::unique_ptr<Mismatch>& mismatch() const { return mismatch_; }
  std::int64_t compared_cells() const { return compared_cells_; }  // behind stages
  // The cycle in which the writer took this token last.
  std::int64_t written_in(std::int64_t ordinal) const {
    return written_in_[static_cast<std::size_t>(ordinal)];
  }

 private:
  struct Channel {
    std::string name;
    StageKind producer = StageKind::reader;
    int cascade = 0;
    std::size_t stage = 0;  // number of the producer in its time step
    bool behind_stage = false;
    std::size_t entering = 0, leaving = 0;  // the passes of the next token to enter, and to leave
    Place place, left;                      // of these tokens
    std::deque<Cell> in_flight;             // copies, apart from the channel's own memory
  };

  // Behind the producer of a channel in one pass; null: not compared.
  const Expected* expected_of(const Channel& channel);
  void compare(const Channel& channel, const Cell* lanes);
  void compare_written(const Channel& channel, const Cell* lanes);
  bool compare(const Channel& channel, const Expected& expected, const Cell& wanted, const Cell& is,
               int lane);  // false: they differ
  void report(const Channel& channel, Mismatch::Kind kind, std::size_t pass, const Place& place, int lane,
              const char* field, std::int64_t expected, std::int64_t actual);

  Pipeline& pipeline_;
  const Shape shape_;
  std::vector<Channel> channels_;
  std::vector<std::int64_t> written_in_;  // by ordinal
  std::deque<Wanted> passes_;             // of the train, without those that have been written
  std::size_t written_ = 0;               // of the train
  Expected read_;                         // what the reader gives
  bool stops_ = true;
  std::unique_ptr<Mismatch> mismatch_;
  std::int64_t compared_cells_ = 0;
};

}  // namespace voxmelt::hwmodel
