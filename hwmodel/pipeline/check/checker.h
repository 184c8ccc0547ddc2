// The checker watches every token of the pipeline. Behind each stage, and behind the reader, a token must
// equal the reference's, side bands included. Lanes beyond the grid must hold the border. A token must leave
// a channel as it entered. The writer's sums over a pass must equal what the reference holds. The first
// difference stops the pass.
//
// Beside a cut of a tile, each stage spoils as many cells as it reaches. They are not compared, unless the
// tile owns them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hwmodel/fabric/ring.h"
#include "hwmodel/pipeline/check/expectation.h"
#include "hwmodel/pipeline/check/mismatch.h"
#include "hwmodel/pipeline/check/wanted_air.h"
#include "hwmodel/pipeline/model/stream_machine.h"
#include "kernel/automaton/state/ledger.h"

namespace voxmelt::hwmodel {

class Checker final : public FifoWatcher<Cell> {
 public:
  explicit Checker(StreamMachine& machine);

  // Tells what a pass has to give for one tile. `steps` has an entry per cascaded step, and an empty one is
  // not compared. `written` is what the pass leaves in memory. If it is null, it is not compared. `left` is
  // the state that the whole pass leaves, or null. `held` is what that state holds, and is given for the
  // last tile alone.
  struct Wanted {
    Pass pass;
    std::vector<std::vector<Expected>> steps;
    std::shared_ptr<const state::Volume> written;
    std::optional<state::Holdings> held;
    std::shared_ptr<const state::Volume> left;
  };
  // Chooses if the checker stops the pass at the first difference. If it does not, the caller must.
  void stop_at_difference(bool stops) { stops_ = stops; }
  void begin_train();
  void add_pass(Wanted wanted);

  const Wanted& being_written() const { return passes_.front(); }
  void report(Mismatch mismatch);  // reports what another checker has seen; the first one counts

  void entered(int channel, std::int64_t ordinal, const Cell* lanes) override;
  void left(int channel, std::int64_t ordinal, const Cell* lanes) override;

  const std::unique_ptr<Mismatch>& mismatch() const { return mismatch_; }
  // Counts the cells compared behind stages. Each cell counts in the tile that owns it.
  std::int64_t compared_cells() const { return compared_cells_; }
  // Returns the cycle in which the writer last took this token. Ordinals count over all tiles of a pass.
  std::int64_t written_in(std::int64_t ordinal) const { return written_in_[ordinal]; }

 private:
  struct Span {  // along x
    int begin = 0, end = 0;
  };
  struct Channel {
    std::string name;
    StageKind producer = StageKind::reader;
    int cascade = 0;
    std::size_t stage = 0;  // number of the producer in its time step
    bool behind_stage = false;
    std::size_t entering = 0, leaving = 0;  // the passes of the next token to enter, and to leave
    Place place, left;                      // places of these tokens
    std::size_t spanned = SIZE_MAX;         // the pass of the next three
    Span span;                              // cells that must be right in the tokens that enter
    const Expected* expected = nullptr;     // what they must be; null: they are not compared
    Expected read;                          // the same where the producer is the reader
    WantedAir air;
    Ring<Cell> in_flight;  // copies, apart from the channel's own memory
  };

  // Returns the cells behind a channel's producer that must be right.
  Span span_of(const Channel& channel, const Pass& pass) const;
  void next_pass(std::size_t& pass, Place& place) const;

  // Returns what is expected behind the producer of a channel in one pass. Null means that it is not
  // compared.
  const Expected* expected_of(Channel& channel) const;
  void compare(Channel& channel, const Cell* lanes);
  bool equals_air(Channel& channel, const Cell* lanes) const;
  bool compare_with_entered(Channel& channel, const Cell* lanes);
  void compare_written(const Channel& channel, const Cell* lanes);
  void compare_memory(const Channel& channel, const state::Volume& volume, int lane, const Cell& is);
  void compare_pass(const Channel& channel);  // after its last tile has been written
  bool compare(const Channel& channel, const Expected& expected, const Cell& wanted, const Cell& is,
               int lane);  // false: they differ
  void report(const Channel& channel, Mismatch::Kind kind, std::size_t pass, const Place& place, int lane,
              std::string_view field, std::int64_t expected, std::int64_t actual);

  StreamMachine& machine_;
  const Shape shape_;
  const std::vector<StageKind> stages_;  // stages of a time step
  std::vector<Channel> channels_;
  std::vector<std::int64_t> written_in_;  // cycles, by ordinal of the token
  std::deque<Wanted> passes_;             // passes of the train, without those that have been written
  std::size_t written_ = 0;               // written passes of the train
  bool stops_ = true;
  std::unique_ptr<Mismatch> mismatch_;
  std::int64_t compared_cells_ = 0;
};

}  // namespace voxmelt::hwmodel
