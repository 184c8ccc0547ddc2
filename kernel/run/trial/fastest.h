// Which implementation `auto` takes: the one that was fastest in a short trial on this processor.
//
// The first program of a build makes the trial. It remembers the answer in `voxmelt/fastest` in the user's
// folder for caches (XDG_CACHE_HOME, or ~/.cache), a line for each of the last builds and processors. Where
// it cannot write there, every program makes the trial. No result depends on the choice.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "kernel/run/trial/trial.h"

namespace voxmelt::run {

struct Choice {
  const step::Implementation* implementation;
  std::string reason;  // "1.84 times as fast as sse4.2 in a trial on this processor"
};

const Choice& fastest();  // of implementations(); decided once in a program

// What a user has asked for: `auto`, which is fastest(), or a name. Throws std::invalid_argument where this
// build, or this processor, does not have it: "unknown; this build has auto, reference, avx2".
Choice chosen(const std::string& name);

using Trial = std::function<std::vector<TrialTime>(const std::vector<const step::Implementation*>&)>;

// The same for any registry, file (empty: none) and trial. `machine` says for what an answer holds, in one
// line. A file that cannot be read, or says nonsense, is as one that is not there.
Choice choose(const step::Registry& registry, const std::filesystem::path& file, const std::string& machine,
              const Trial& trial);

}  // namespace voxmelt::run
