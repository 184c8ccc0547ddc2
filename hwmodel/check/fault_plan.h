// Faults are planted in a machine to see that its checker finds them. A machine lists its faults, one row
// each. A plan has one of them. It strikes once, at the first place where it makes a difference, and notes
// where it leaves something wrong.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hwmodel/fabric/index_of.h"

namespace voxmelt::hwmodel::check {

template <class Fault>
struct FaultInfo {
  Fault fault;
  // Give the fault's name for --plant, the stage where it strikes, and what goes wrong.
  std::string_view name, stage, what;
};

// Checks that each fault from `none` to `end` has a row, in the order of the enumerators. A fault without a
// row would never be tested.
template <class Fault, std::size_t kRows>
constexpr bool lists_all(const std::array<FaultInfo<Fault>, kRows>& rows) {
  std::size_t expected = index_of(Fault::none);
  for (const FaultInfo<Fault>& row : rows)
    if (index_of(row.fault) != ++expected) return false;
  return ++expected == index_of(Fault::end);
}

// Returns null if no fault has this name.
template <class Fault>
const FaultInfo<Fault>* find_fault(std::span<const FaultInfo<Fault>> rows, std::string_view name) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const FaultInfo<Fault>& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

// A `Place` says where a fault strikes, in the words of its machine.
template <class Fault, class Place>
class FaultPlan {
 public:
  using Strike = Place;

  FaultPlan() = default;
  // Strikes from a time step on. A fault of channels strikes in one channel.
  explicit FaultPlan(Fault fault, std::uint32_t first_step = 0, std::string channel = {})
      : fault_(fault), first_step_(first_step), channel_(std::move(channel)) {}

  Fault fault() const { return fault_; }
  std::uint32_t first_step() const { return first_step_; }
  const std::string& channel() const { return channel_; }

  bool armed(Fault fault) const { return fault == fault_ && !struck_; }
  bool armed(Fault fault, std::uint32_t step) const { return armed(fault) && step >= first_step_; }
  void strike(Strike strike) { struck_ = std::move(strike); }
  const std::optional<Strike>& struck() const { return struck_; }

  // Keeps a part of the fault as long as the plan lives.
  void keep(std::shared_ptr<void> part) { kept_.push_back(std::move(part)); }

 private:
  Fault fault_ = Fault::none;
  std::uint32_t first_step_ = 0;
  std::string channel_;
  std::vector<std::shared_ptr<void>> kept_;
  std::optional<Strike> struck_;
};

// Holds what the fault policies of all stages share. A policy takes the place of NoFaults in a stage,
// and is called at the points named there.
template <class Plan>
class Planted {
 public:
  explicit Planted(Plan& plan) : plan_(&plan) {}

 protected:
  Plan& plan() const { return *plan_; }

 private:
  Plan* plan_;
};

}  // namespace voxmelt::hwmodel::check
