// The controller's part that refreshes: all banks of a rank together, or some banks while others work.
#include <algorithm>
#include <cstdint>

#include "hwmodel/memory/controller.h"

namespace voxmelt::hwmodel::memory {

bool Controller::refresh(std::int64_t now, std::int64_t& next) {
  for (int r = 0; r < parameters_.ranks; ++r) {
    if (now < ranks_[r].due) {
      next = std::min(next, ranks_[r].due);
      continue;
    }
    if (parameters_.by_bank ? refresh_banks(r, now, next) : refresh_rank(r, now, next)) return true;
  }
  return false;
}

// The rank's banks are closed together. The rank takes no other command until it is refreshed.
bool Controller::refresh_rank(int r, std::int64_t now, std::int64_t& next) {
  RankState& rank = ranks_[r];
  for (BankState& bank : rank.banks()) bank.closing = true;
  const bool open = std::any_of(rank.banks().begin(), rank.banks().end(),
                                [](const BankState& bank) { return bank.open >= 0; });
  std::int64_t from = bus_free_[0];
  for (const BankState& bank : rank.banks()) {
    if (!open) from = std::max(from, bank.activate);
    if (bank.open >= 0) from = std::max(from, rank.may_precharge(bank));
  }
  if (now < from) {
    next = std::min(next, from);
    return false;
  }
  Location at;
  at.rank = r;
  if (open) {
    for (BankState& bank : rank.banks()) rank.precharge(bank, now, parameters_.rp_all, parameters_);
    tell(now, Command::Kind::precharge_all, at);
    bus_free_[0] = now + parameters_.pre_slots;
    ++counts_.precharges;
  } else {
    rank.refresh(now, parameters_);
    for (BankState& bank : rank.banks()) bank.closing = false;
    tell(now, Command::Kind::refresh, at);
    bus_free_[0] = now + parameters_.ref_slots;
    rank.due += parameters_.refi;
    account_.refreshed();
    ++counts_.refreshes;
  }
  return true;
}

// Banks take turns. Those whose turn it is are closed one after the other, and the others go on.
bool Controller::refresh_banks(int r, std::int64_t now, std::int64_t& next) {
  const Parameters& p = parameters_;
  RankState& rank = ranks_[r];
  const int apart = p.groups / p.groups_at_once;  // groups that one command refreshes lie so far apart
  Location at;
  at.rank = r;
  at.group = rank.turn % apart;
  at.bank = rank.turn / apart;
  std::int64_t refreshes = bus_free_[0];
  bool open = false;
  for (int g = at.group; g < p.groups; g += apart) {
    BankState& bank = rank.bank(g, at.bank);
    bank.closing = true;
    refreshes = std::max(refreshes, rank.may_refresh(bank, g, p));
    if (bank.open < 0) continue;
    open = true;
    const std::int64_t from = std::max(bus_free_[0], rank.may_precharge(bank));
    if (now < from) {
      next = std::min(next, from);
      continue;
    }
    rank.precharge(bank, now, p.rp, p);
    at.group = g;
    tell(now, Command::Kind::precharge, at);
    bus_free_[0] = now + p.pre_slots;
    ++counts_.precharges;
    return true;
  }
  if (open) return false;
  if (now < refreshes) {
    next = std::min(next, refreshes);
    return false;
  }
  rank.refresh_bank(at.bank, at.group, now, p);
  tell(now, Command::Kind::refresh_bank, at);
  bus_free_[0] = now + p.ref_slots;
  rank.due += p.refi_bank;
  rank.turn = (rank.turn + 1) % p.refreshes_of_rank();
  ++counts_.bank_refreshes;
  return true;
}

}  // namespace voxmelt::hwmodel::memory
