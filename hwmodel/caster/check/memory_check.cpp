#include "hwmodel/caster/check/memory_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr int kChannelsOfAPipe = 100;

std::string text_of(const LineReply& reply) {
  return fmt::format("client {}, slot {}, {} bytes at {}", reply.client, reply.slot, reply.bytes,
                     reply.address);
}

}  // namespace

std::vector<LineReply>& MemoryCheck::of_pipe(int channel) {
  const std::size_t pipe = channel / kChannelsOfAPipe;
  if (pipe >= under_way_.size()) under_way_.resize(pipe + 1);
  return under_way_[pipe];
}

void MemoryCheck::entered(int channel, std::int64_t, const LineRequest* request) {
  if (!request->write)
    of_pipe(channel).push_back({request->client, request->slot, request->address, request->bytes});
}

void MemoryCheck::left(int channel, std::int64_t, const LineReply* reply) {
  ++compared_;
  std::vector<LineReply>& asked = of_pipe(channel);
  const auto found = std::find_if(asked.begin(), asked.end(), [&](const LineReply& line_reply) {
    return line_reply.client == reply->client && line_reply.slot == reply->slot &&
           line_reply.address == reply->address && line_reply.bytes == reply->bytes;
  });
  if (found != asked.end()) {
    asked.erase(found);
    return;
  }
  Difference difference;
  difference.stage = "memory";
  difference.name = fmt::format("reply to pipe {}", channel / kChannelsOfAPipe);
  difference.address = reply->address;
  difference.expected = asked.empty() ? "none" : text_of(asked.front());
  difference.actual = text_of(*reply);
  tell_(std::move(difference));
}

}  // namespace voxmelt::hwmodel::raycast
