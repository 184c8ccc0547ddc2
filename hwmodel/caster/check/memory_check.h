// A pipe must get the lines for which it asked, each once. The client, the slot and the address of a reply
// must be those of a request that this pipe sent and that has no reply yet.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "hwmodel/caster/check/difference.h"
#include "hwmodel/caster/model/pipe.h"

namespace voxmelt::hwmodel::raycast {

class MemoryCheck final : public FifoWatcher<LineRequest>, public FifoWatcher<LineReply> {
 public:
  using Tell = std::function<void(Difference)>;
  explicit MemoryCheck(Tell tell) : tell_(std::move(tell)) {}

  void begin_pass() { under_way_.clear(); }
  std::int64_t compared() const { return compared_; }  // compared replies

  void entered(int channel, std::int64_t ordinal, const LineRequest* request) override;
  void left(int, std::int64_t, const LineRequest*) override {}
  void entered(int, std::int64_t, const LineReply*) override {}
  void left(int channel, std::int64_t ordinal, const LineReply* reply) override;

 private:
  std::vector<LineReply>& of_pipe(int channel);

  Tell tell_;
  std::vector<std::vector<LineReply>> under_way_;  // lines that are asked for, by pipe
  std::int64_t compared_ = 0;
};

}  // namespace voxmelt::hwmodel::raycast
