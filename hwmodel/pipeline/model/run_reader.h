// A run shows the same for all of its cells, so the memories of viscous spread store it once per run. It is
// read back as the column passes a tap, bottom first. The head lies in the word of the run's first cell. The
// rest lies in the word of the blocked cell below it (which holds no arrivals and has room for it). So does
// the rise of the bed, if that cell is solid: it is computed once, when the cell comes. For a run on the
// grid's floor, the rest lies in a word per column beside the planes. The column also tells what a cell
// outside a run shows (docs/automaton.md, end of section 10).
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/model/viscous_run.h"

namespace voxmelt::hwmodel {

enum class Ground : std::uint8_t { solid, inert, outside, run };

inline constexpr std::int64_t kNoBed = -1;  // bed of a cell in the air

// Tells how fast, and from which difference of heads on, a run flows. Two shut runs give each other nothing.
struct RunPace {
  UInt<22> mobility;  // not limited yet
  UInt<14> limit;     // 0: no run
  UInt<25> dead;
  UInt<1> shut;
  static constexpr int kBits = 22 + 14 + 25 + 1;

  std::int64_t limited() const { return std::min<std::int64_t>(mobility, limit << 8); }  // towards a run
  std::int64_t exposed() const { return std::min<std::int64_t>(mobility, 1 << 21); }  // towards a bare flank
};

struct SpreadWord {
  Ground ground = Ground::inert;
  UInt<1> beside_wall;
  UInt<16> amount = kFlatBed, heat;  // unchanged; a pair looks at these
  // The following belong to a cell that is not blocked.
  UInt<16> present;                             // amount after the pairs done so far
  UInt<32> content;                             // amount x heat after them
  SInt<30> head;                                // head of the run, in its first cell
  UInt<1> west_blocked = 1, south_blocked = 1;  // the cells that came before it, beside it
  SInt<6> west_rise, south_rise;                // how far the bed rises from those cells
  UInt<1> set;                                  // it gives nothing
  // The following belong to a blocked cell.
  RunPace above;                     // pace of the run that begins in the next cell up
  UInt<SolidBed::kRiseBits> melted;  // rise of a solid's bed; an inert cell's follows from its amount
  UInt<4> material;                  // of a solid, in scenes with several

  bool blocked() const { return ground == Ground::solid || ground == Ground::inert; }
  bool runs() const { return ground == Ground::run; }
  // Returns the rise of the bed that a blocked cell is.
  UInt<14> rise() const { return ground == Ground::solid ? UInt<14>(melted) : rise_of_inert(amount); }

  // Returns the bits of a word. The two kinds share them.
  static int bits(int head_bits, const Design& design) {
    const int more = open_bits(design), heat = design.hot() ? 16 : 0;
    const int blocked = kDoneBits + heat + RunPace::kBits + SolidBed::kRiseBits + solid_bits(design);
    const int open = kDoneBits + 16 + heat + (design.hot() ? 32 : 0) + head_bits + 2 + 2 * 6 + more;
    return std::max(blocked, open);
  }
  // Counts the bits that are kept once all pairs of a cell are done: ground, amount, heat, and either wall
  // and set or the material.
  static int done_bits(const Design& design) {
    return kDoneBits + (design.hot() ? 16 : 0) + std::max(open_bits(design), solid_bits(design));
  }

 private:
  static constexpr int kDoneBits = 2 + 16;

  static int open_bits(const Design& design) {
    return (design.needs_walls() ? 1 : 0) + (design.freezes() ? 1 : 0);
  }
  static int solid_bits(const Design& design) { return design.of_materials() ? 4 : 0; }
};

// Describes a cell in the window: its word, its place along x, and what it shows.
struct SeenCell {
  SpreadWord* word = nullptr;
  int x = 0;
  SInt<30> head;
  RunPace pace;
  SInt<18> bed = kNoBed;  // 1/16 cell

  bool blocked() const { return word->blocked(); }
};

// Returns how far the bed rises from a cell to another one, in 1/16 cell, below 0 if it falls. It is 0 where
// one of them is blocked or shows none.
inline SInt<6> bed_rise(const SeenCell& from, const SeenCell& to) {
  if (from.blocked() || to.blocked() || from.bed == kNoBed || to.bed == kNoBed) return 0;
  return std::clamp<std::int64_t>(std::int64_t{to.bed} - from.bed, -31, 31);
}

// Reads one lane of one tap. Its registers hold the run being read.
class RunReader {
 public:
  // Returns true if this cell, should it be in a run, is the run's first.
  bool above_blocked(int y) const { return y == 0 || below_ == Below::blocked; }
  // At the tap where cells come, the pace comes with the run's first cell.
  void bring(const RunPace& pace) { next_ = pace; }
  void bring_floor(const RunPace& pace) {
    below_ = Below::blocked;
    rise_ = kFlatRise;
    next_ = pace;
  }

  // Reads the next cell upwards.
  void read(SeenCell& seen, int y) {
    const SpreadWord& word = *seen.word;
    if (word.blocked()) {
      below_ = Below::blocked;
      rise_ = word.rise();
      next_ = word.above;
      return;
    }
    if (word.runs()) {
      if (below_ == Below::blocked) {
        head_ = word.head;
        pace_ = next_;
        run_bed_ = bed_head(y, rise_) >> 5;
      }
      below_ = Below::run;
      seen.head = head_;
      seen.pace = pace_;
      seen.bed = run_bed_;
      return;
    }
    seen.pace = {};
    seen.head = 512 * (y - 2);
    seen.bed = kNoBed;
    if (below_ == Below::blocked) {
      seen.head = bed_head(y, rise_);
      seen.bed = seen.head >> 5;
    }
    if (below_ == Below::run) {
      seen.head = head_;
      seen.bed = run_bed_;
      seen.pace.mobility = pace_.mobility;
      seen.pace.limit = pace_.limit;
    }
    below_ = Below::outside;
  }

 private:
  enum class Below : std::uint8_t { blocked, run, outside };

  Below below_ = Below::blocked;
  UInt<14> rise_ = kFlatRise;  // of the bed, the blocked cell below
  SInt<30> head_;
  SInt<18> run_bed_;
  RunPace pace_, next_;
};

}  // namespace voxmelt::hwmodel
