#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/ray_caster.h"

namespace voxmelt::hwmodel::raycast {

std::vector<TokenChannel> RayCaster::token_channels() const {
  std::vector<TokenChannel> all;
  for (int i = 0; i < pipes(); ++i)
    for (TokenChannel& channel : pipe(i).token_channels()) {
      channel.name = "pipe " + std::to_string(i) + ": " + channel.name;
      all.push_back(std::move(channel));
    }
  return all;
}

// Idle cycles have no class, because it is known only later if they were a fill or a drain.
std::vector<StageClasses> RayCaster::stage_classes() const {
  std::vector<StageClasses> all;
  for (int i = 0; i < pipes(); ++i)
    for (const Stage* stage : pipe(i).stages())
      all.push_back({"pipe " + std::to_string(i) + ' ' + stage->name(), {"busy", "blocked", "memory"}});
  return all;
}

std::vector<std::int64_t> RayCaster::stage_counts() const {
  std::vector<std::int64_t> counts;
  for (int i = 0; i < pipes(); ++i)
    for (const Stage* stage : pipe(i).stages()) {
      const Account& account = stage->account();
      counts.insert(counts.end(), {account.busy, account.blocked, account.memory});
    }
  return counts;
}

}  // namespace voxmelt::hwmodel::raycast
