#include "hwmodel/caster/check/memory_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr int kChannelsOfAPipe = 100;

std::string text_of(const LineReply& of) {
  return fmt::format("client {}, slot {}, {} bytes at {}", of.client, of.slot, of.bytes, of.address);
}

}  // namespace

std::vector<LineReply>& MemoryCheck::of_pipe(int channel) {
  const auto pipe = static_cast<std::size_t>(channel / kChannelsOfAPipe);
  if (pipe >= under_way_.size()) under_way_.resize(pipe + 1);
  return under_way_[pipe];
}

void MemoryCheck::entered(int channel, std::int64_t, const LineRequest* of) {
  if (!of->write) of_pipe(channel).push_back({of->client, of->slot, of->address, of->bytes});
}

void MemoryCheck::left(int channel, std::int64_t, const LineReply* reply) {
  ++compared_;
  std::vector<LineReply>& asked = of_pipe(channel);
  const auto found = std::find_if(asked.begin(), asked.end(), [&](const LineReply& of) {
    return of.client == reply->client && of.slot == reply->slot && of.address == reply->address &&
           of.bytes == reply->bytes;
  });
  if (found != asked.end()) {
    asked.erase(found);
    return;
  }
  Difference of;
  of.stage = "memory", of.name = fmt::format("reply to pipe {}", channel / kChannelsOfAPipe);
  of.address = reply->address;
  of.expected = asked.empty() ? "none" : text_of(asked.front());
  of.actual = text_of(*reply);
  tell_(std::move(of));
}

}  // namespace voxmelt::hwmodel::raycast
