// The checker holds a stream of commands against the rules of a data sheet. It looks back from each command
// to those before it. It shares no code with the controller, only the numbers and the form of a command.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hwmodel/memory/command.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::memory {

class TimingChecker final : public CommandListener {
 public:
  explicit TimingChecker(const Parameters& parameters);

  void issued(const Command& command) override;
  // Checks at the end of a stream that enough refreshes came.
  void finish(std::int64_t cycle);

  std::int64_t commands() const { return commands_; }
  std::int64_t violations() const { return violations_; }
  const std::map<std::string, std::int64_t>& by_rule() const { return by_rule_; }
  const std::string& first() const { return first_; }  // the first violation, in words

 private:
  static constexpr std::int64_t kNever = -1'000'000'000;
  struct Bank {
    bool open = false;
    int row = 0;
    std::int64_t activate = kNever, precharge = kNever, read = kNever, write = kNever;
    bool closed_with_all = false;
    std::int64_t refresh = kNever, refreshes = 0;  // of banks
  };
  struct Group {
    std::int64_t activate = kNever, read = kNever, write = kNever;
  };
  struct Rank {
    std::vector<Bank> banks;
    std::vector<Group> groups;
    std::array<std::int64_t, 4> activates{kNever, kNever, kNever, kNever};  // the newest is first
    std::int64_t precharge = kNever;                                        // of any bank
    std::int64_t refresh = kNever, refreshes = 0;
    std::int64_t bank_refresh = kNever, bank_refreshes = 0;  // of any of its banks
  };
  struct Channel {
    std::vector<Rank> ranks;
    std::array<std::int64_t, 2> bus_until{};  // for each command bus, the first free cycle
    std::int64_t data_until = kNever;
    bool data_of_write = false;
    int data_of_rank = -1;
  };

  void at_least(const char* rule, std::int64_t from, int cycles, const Command& command);
  void must(const char* rule, bool holds, const Command& command);
  void check_bus(Channel& channel, const Command& command);
  void check_activate(Rank& rank, const Command& command);
  void check_precharge(const Bank& bank, const Command& command);
  void check_distance(Rank& rank, const Command& command);
  void check_column(Channel& channel, Rank& rank, const Command& command);
  void check_data(Channel& channel, const Command& command);
  void check_refresh(Rank& rank, const Command& command);
  void check_bank_refresh(Rank& rank, const Command& command);
  bool enough_refreshes(const Rank& rank, std::int64_t cycle) const;
  Bank& bank_of(Rank& rank, const Command& command);

  Parameters sheet_;
  std::vector<Channel> channels_;
  std::int64_t commands_ = 0, violations_ = 0;
  std::map<std::string, std::int64_t> by_rule_;
  std::string first_;
};

}  // namespace voxmelt::hwmodel::memory
