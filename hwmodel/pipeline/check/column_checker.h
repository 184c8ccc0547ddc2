// The checker compares every column that is written with hw.coded, as soon as it is complete. It compares
// which tokens are stored, and what they hold. It reads the slot with code of its own.
#pragma once

#include <cstdint>
#include <string_view>

#include "hwmodel/pipeline/check/checker.h"

namespace voxmelt::hwmodel {

class ColumnChecker final : public ColumnWatcher {
 public:
  ColumnChecker(StreamMachine& machine, Checker& checker) : machine_(machine), checker_(checker) {}

  void column_written(const Place& place, const std::uint64_t* slot) override;

 private:
  bool differs(const Place& place, int lane, std::string_view field, std::int64_t expected,
               std::int64_t actual);

  StreamMachine& machine_;
  Checker& checker_;
};

}  // namespace voxmelt::hwmodel
