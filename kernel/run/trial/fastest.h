// `auto` takes the implementation that was fastest in a short trial on this processor.
//
// The first program of a build makes the trial. It remembers the answer in `voxmelt/fastest` in the user's
// folder for caches (XDG_CACHE_HOME, or ~/.cache), a line for each of the last builds and processors. If it
// cannot write there, every program makes the trial. No result depends on the choice.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "kernel/run/trial/trial.h"

namespace voxmelt::run {

struct Choice {
  const step::Implementation* implementation;
  std::string reason;                           // "1.84 times as fast as sse4.2 in a trial on this processor"
  const step::Implementation* spare = nullptr;  // of a card: what goes on if the card fails
};

const Choice& fastest();  // one of implementations(), decided once in a program

// Returns the choice of a user: `auto`, which is fastest(), or a name. `gpu` is the first device. It throws
// std::invalid_argument if this build, or this machine, does not have it: "unknown; this build has auto,
// reference, avx2".
Choice chosen(const std::string& name);

// Returns what `auto` means for whole steps that stay on a device: a graphics card, if one was faster in a
// trial beside fastest(), which is its spare; otherwise fastest(). A device that is no card is never taken.
const Choice& fastest_for_steps();

using Trial = std::function<std::vector<TrialTime>(const std::vector<const step::Implementation*>&)>;

// Does the same for any registry, file (empty: none) and trial. `machine` names in one line the machine for
// which an answer holds. A file that is unreadable or has nonsense counts as missing.
Choice choose(const step::Registry& registry, const std::filesystem::path& file, const std::string& machine,
              const Trial& trial);

// Does the same for cards. `devices` is asked for only if no answer is remembered, or it is a card.
using Devices = std::function<const step::Registry&()>;
Choice choose_for_steps(const Choice& processor, const Devices& devices, const std::filesystem::path& file,
                        const std::string& machine, const Trial& trial);

}  // namespace voxmelt::run
