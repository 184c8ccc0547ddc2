// These faults lose flows, do not quarter them, or use the friction of the wrong ground.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/apply_stage.h"

namespace voxmelt::hwmodel {

class ApplyFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Apply<ApplyFaults>;

  void gift(Faulty& stage, const Flowing& giver, bool diagonal, const Flowing& to, PaperFlow::Gift& gift) {
    if (armed(stage, Fault::apply_flow_lost) && gift.amount > 0) {
      gift = {};
      return strike_word(stage, stage.line_, to);
    }
    // All that may still come must have room above the wrong flow, in the southern sums too.
    const std::int64_t whole = giver.axis[0].amount;
    if (armed(stage, Fault::apply_diagonal_whole) && diagonal && gift.amount < whole &&
        whole < 3 * (kOne >> 2) && to.amount + whole + 5 * kOne <= kAmountMax) {
      gift.amount = whole;
      return strike_word(stage, stage.line_, to);
    }
    if (armed(stage, Fault::apply_alpha) && stage.printed_ && rubbed_too_little_[&to] == 0)
      rubbed_too_little_[&to] =
          stage.rubbed(gift.energy, wrong_footing(giver)) - stage.rubbed(gift.energy, giver.footing);
  }

  void finished(Faulty& stage, const Flowing& word, std::int64_t amount, std::int64_t& energy) {
    if (!armed(stage, Fault::apply_alpha)) return;
    const std::int64_t gained = stage.printed_ ? word.in.energy + rubbed_too_little_[&word]
                                               : stage.rubbed_at_end(word, wrong_footing(word));
    rubbed_too_little_.erase(&word);
    const std::int64_t wrong = std::clamp<std::int64_t>(word.left_energy + gained, 0, amount);
    if (wrong == energy) return;
    energy = wrong;
    strike_word(stage, stage.line_, word);
  }

 private:
  static std::int64_t wrong_footing(const Flowing& word) { return (word.footing + 1) % 3; }

  // Holds the energy that the first flow with the wrong friction adds to a word that waits in the line.
  std::map<const Flowing*, std::int64_t> rubbed_too_little_;
};

}  // namespace voxmelt::hwmodel
