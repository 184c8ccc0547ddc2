// Watches every token of the pipeline. Behind each stage, and behind the reader, it must equal the
// reference's, side bands included. Lanes beyond the grid must hold the border. What leaves a channel must be
// what entered it. The first difference stops the pass.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/lockstep/expectation.h"
#include "hwmodel/lockstep/mismatch.h"
#include "hwmodel/stream/pipeline.h"

namespace voxmelt::hwmodel {

class Checker final : public FifoWatcher<Cell> {
 public:
  explicit Checker(Pipeline& pipeline);

  // `expected` has an entry per cascaded step; an empty one is not compared.
  void begin_pass(std::uint32_t first_step, const std::vector<std::vector<Expected>>& expected);

  void entered(int channel, std::int64_t ordinal, const Cell* lanes) override;
  void left(int channel, std::int64_t ordinal, const Cell* lanes) override;

  const std::unique_ptr<Mismatch>& mismatch() const { return mismatch_; }
  std::int64_t compared_cells() const { return compared_cells_; }  // behind stages
  // The cycle in which the writer took this token of the last pass.
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
    std::optional<Expected> expected;
    Place place;                 // of the next token to enter
    std::deque<Cell> in_flight;  // copies, apart from the channel's own memory
  };

  void compare(const Channel& channel, const Cell* lanes);
  bool compare(const Channel& channel, const Cell& wanted, const Cell& is, int lane);  // false: they differ
  void report(const Channel& channel, Mismatch::Kind kind, const Place& place, int lane, const char* field,
              std::int64_t expected, std::int64_t actual);

  Pipeline& pipeline_;
  const Shape shape_;
  std::vector<Channel> channels_;
  std::vector<std::int64_t> written_in_;  // by ordinal
  std::uint32_t first_step_ = 0;
  std::unique_ptr<Mismatch> mismatch_;
  std::int64_t compared_cells_ = 0;
};

}  // namespace voxmelt::hwmodel
