#include "hwmodel/memory/dram.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel::memory {
namespace {

constexpr std::int64_t kNotDone = std::numeric_limits<std::int64_t>::max();

}  // namespace

Dram::Dram(const Parameters& parameters, int machine_mhz, const Policy& policy)
    : parameters_(parameters),
      policy_(policy),
      machine_mhz_(machine_mhz),
      wake_(parameters.channels, 0),
      turn_(parameters.channels, 0) {
  for (int c = 0; c < parameters.channels; ++c) channels_.emplace_back(parameters_, policy_, c);
}

int Dram::open_port(PortClient* client) {
  ports_.emplace_back().client = client;
  return static_cast<int>(ports_.size()) - 1;
}

bool Dram::ready(int port) const {
  const Port& the_port = ports_[port];
  return std::ssize(the_port.inbox) < policy_.inbox && std::ssize(the_port.reads) < policy_.under_way;
}

void Dram::put(int port, const Request& request) {
  Port& to = ports_[port];
  std::int64_t number = 0;
  if (!request.write) {
    number = to.first_read + to.reads.size();
    to.reads.push_back({request, kNotDone});
  }
  to.inbox.push_back({request, now_, number, false});
}

const Request* Dram::reply(int port) const {
  const Port& the_port = ports_[port];
  return the_port.reads.empty() || the_port.reads.front().done > now_ ? nullptr
                                                                      : &the_port.reads.front().request;
}

void Dram::take(int port) {
  Port& the_port = ports_[port];
  the_port.reads.pop_front();
  ++the_port.first_read;
}

bool Dram::cycle() {
  const std::int64_t before = moves_;
  ++machine_cycle_;
  run(machine_cycle_ * parameters_.mhz / machine_mhz_);
  return moves_ != before;
}

void Dram::run(std::int64_t end) {
  while (now_ < end) {
    std::int64_t next = end;
    for (int c = 0; c < std::ssize(channels_); ++c) {
      if (take_request(c)) {
        wake_[c] = now_;
        next = now_ + 1;
      }
      if (wake_[c] <= now_) {
        Controller::Done done;
        wake_[c] = channels_[c].step(now_, done);
        if (done.any) finish(done);
      }
      next = std::min(next, wake_[c]);
    }
    now_ = std::max(now_ + 1, next);
  }
}

// Takes at most one request per cycle and channel, from one port after the other.
bool Dram::take_request(int channel) {
  Controller& controller = channels_[channel];
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const std::size_t at = (turn_[channel] + i) % ports_.size();
    Port& port = ports_[at];
    if (port.inbox.empty()) continue;
    Waiting& waiting = port.inbox.front();
    const Request& request = waiting.request;
    const Location location = locate(request.address, parameters_);
    if (location.channel != channel || !controller.has_room(request.write)) continue;
    if (controller.must_wait(request.address, request.write)) {
      controller.held += waiting.held ? 0 : 1;
      waiting.held = true;
      continue;
    }
    Entry entry;
    entry.address = request.address;
    entry.put = waiting.put;
    entry.at = location;
    entry.write = request.write;
    entry.port = static_cast<int>(at);
    entry.id = request.id;
    entry.number = waiting.number;
    controller.take(entry, now_);
    if (trace_ != nullptr) trace_->taken(now_, request);
    port.inbox.pop_front();
    turn_[channel] = (at + 1) % ports_.size();
    ++moves_;
    return true;
  }
  return false;
}

void Dram::finish(const Controller::Done& done) {
  const Entry& entry = done.entry;
  Port& port = ports_[entry.port];
  const Request request{entry.address, entry.id, entry.write, kBurst};
  if (port.client != nullptr) port.client->performed(request);
  const std::int64_t took = done.at - entry.put;
  if (entry.write) {
    latencies_.worst_write = std::max(latencies_.worst_write, took);
  } else {
    latencies_.read_latency += took;
    latencies_.worst_read = std::max(latencies_.worst_read, took);
    port.reads[entry.number - port.first_read].done = done.at;
  }
  ++moves_;
}

bool Dram::idle() const {
  return std::all_of(ports_.begin(), ports_.end(),
                     [](const Port& port) { return port.inbox.empty() && port.reads.empty(); }) &&
         std::all_of(channels_.begin(), channels_.end(), [](const Controller& c) { return c.empty(); });
}

bool Dram::works() const {
  const auto waits = [&](const Port& port) {
    return !port.inbox.empty() || std::any_of(port.reads.begin(), port.reads.end(),
                                              [&](const UnderWay& read) { return read.done > now_; });
  };
  return std::any_of(ports_.begin(), ports_.end(), waits) ||
         std::any_of(channels_.begin(), channels_.end(), [](const Controller& c) { return !c.empty(); });
}

void Dram::require(std::int64_t bytes, std::string_view what) const {
  if (bytes > parameters_.bytes())
    throw scene::InputError("hw.memory: error: " + parameters_.name + " has " +
                            std::to_string(parameters_.bytes()) + " bytes; " + std::string(what) + " take " +
                            std::to_string(bytes));
}

Counts Dram::counts() const {
  Counts counts = latencies_;
  for (const Controller& channel : channels_) counts += channel.counts(now_);
  return counts;
}

void Dram::listen(CommandListener* listener) {
  for (Controller& channel : channels_) channel.listen(listener);
}

}  // namespace voxmelt::hwmodel::memory
