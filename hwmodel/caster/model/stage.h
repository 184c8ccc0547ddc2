// A stage of the ray caster is evaluated once a cycle. Each evaluation is of exactly one of six kinds.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace voxmelt::hwmodel::raycast {

enum class Did : std::uint8_t { busy, starved, blocked, memory };

// In `memory` it waits for the memory. `fill` is before its first token came, and `drain` after its last one.
struct Account {
  std::int64_t busy = 0, starved = 0, blocked = 0, memory = 0, fill = 0, drain = 0;
  std::int64_t total() const { return busy + starved + blocked + memory + fill + drain; }
};

class Stage {
 public:
  explicit Stage(std::string name) : name_(std::move(name)) {}
  virtual ~Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Runs one cycle. Tells whether anything moved.
  bool run() {
    const Did did = cycle();
    waits_ = did == Did::memory;
    if (did == Did::starved) {
      ++(started_ ? idle_ : account_.fill);
      return false;
    }
    account_.starved += std::exchange(idle_, 0);
    started_ = true;
    ++(did == Did::busy ? account_.busy : did == Did::blocked ? account_.blocked : account_.memory);
    return did == Did::busy;
  }
  // Ends the pass after its last cycle. The cycles that were idle since the last token are drain.
  void end_pass() {
    account_.drain += std::exchange(idle_, 0);
    started_ = false;
  }

  const std::string& name() const { return name_; }
  const Account& account() const { return account_; }
  bool waits_for_memory() const { return waits_; }

 protected:
  virtual Did cycle() = 0;

 private:
  std::string name_;
  Account account_;
  std::int64_t idle_ = 0;
  bool started_ = false, waits_ = false;
};

}  // namespace voxmelt::hwmodel::raycast
