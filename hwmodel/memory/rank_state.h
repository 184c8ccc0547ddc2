// The state of a rank tells from which cycle on it may take which command. Every command that is issued moves
// these cycles forward.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::memory {

inline constexpr std::int64_t kLongAgo = std::numeric_limits<std::int64_t>::min() / 4;

struct BankState {
  int open = -1;                                         // open row; -1: none
  std::int64_t activate = 0, column = 0, precharge = 0;  // first cycle in which each may come
  bool closing = false;                                  // it is closed for a refresh
  bool refreshed = false;                                // and nothing has moved since
};

// Tracks the rows of one rank.
class RankState {
 public:
  explicit RankState(const Parameters& p)
      : due(p.refi),
        banks_(p.banks_of_rank()),
        groups_(p.groups, 0),
        four_(4, kLongAgo),
        banks_of_group_(p.banks) {}

  BankState& bank(int group, int bank_of_group) { return banks_[group * banks_of_group_ + bank_of_group]; }
  std::vector<BankState>& banks() { return banks_; }

  std::int64_t may_activate(const BankState& bank, int group, const Parameters& p) const {
    return std::max({bank.activate, groups_[group], four_[oldest_] + p.faw});
  }
  void activate(BankState& bank, int group, int row, std::int64_t now, const Parameters& p) {
    account(now);
    ++open_;
    bank = {row, now + p.rc, now + p.rcd, now + p.ras, bank.closing, bank.refreshed};
    for (int g = 0; g < std::ssize(groups_); ++g)
      groups_[g] = std::max(groups_[g], now + (g == group ? p.rrd_l : p.rrd_s));
    notes_activation(now);
  }
  std::int64_t may_precharge(const BankState& bank) const {
    return std::max(bank.precharge, next_precharge_);
  }
  void precharge(BankState& bank, std::int64_t now, int cycles, const Parameters& p) {
    account(now);
    if (bank.open >= 0) --open_;
    bank.open = -1;
    bank.activate = std::max(bank.activate, now + cycles);
    next_precharge_ = now + p.ppd;
  }
  void refresh(std::int64_t now, const Parameters& p) {
    account(now);
    refreshes_until_ = std::max(refreshes_until_, now + p.rfc);
    for (BankState& bank : banks_) bank.activate = std::max(bank.activate, now + p.rfc);
  }

  // A refresh of some banks counts as ACT for the four of tFAW.
  std::int64_t may_refresh(const BankState& bank, int group, const Parameters& p) const {
    return std::max(may_activate(bank, group, p), next_refresh_);
  }
  void refresh_bank(int bank_of_group, int group, std::int64_t now, const Parameters& p) {
    account(now);
    refreshes_until_ = std::max(refreshes_until_, now + p.rfc_bank);
    for (int g = group; g < std::ssize(groups_); g += p.groups / p.groups_at_once) {
      BankState& of_set = bank(g, bank_of_group);
      of_set.activate = std::max(of_set.activate, now + p.rfc_bank);
      of_set.closing = false;
      of_set.refreshed = true;
    }
    for (std::int64_t& from : groups_) from = std::max(from, now + p.ref_to_act);
    next_refresh_ = now + p.ref_to_ref;
    notes_activation(now);
  }

  // Counts the cycles before `now` in which a row was open or a refresh ran.
  std::int64_t active(std::int64_t now) const {
    const std::int64_t end = open_ > 0 ? now : std::min(now, refreshes_until_);
    return active_ + std::max<std::int64_t>(0, end - accounted_);
  }

  std::int64_t due;  // cycle of the next refresh
  int turn = 0;      // number of the banks that it will be of

 private:
  void notes_activation(std::int64_t now) {
    four_[oldest_] = now;
    oldest_ = (oldest_ + 1) % four_.size();
  }
  void account(std::int64_t now) {
    active_ = active(now);
    accounted_ = now;
  }

  std::vector<BankState> banks_;
  std::vector<std::int64_t> groups_;  // first cycle in which a bank of each may be activated
  std::vector<std::int64_t> four_;    // cycles of the last four ACT
  std::size_t oldest_ = 0;
  std::int64_t next_precharge_ = kLongAgo, next_refresh_ = kLongAgo;
  int banks_of_group_;
  int open_ = 0;  // banks with an open row
  std::int64_t active_ = 0, accounted_ = 0, refreshes_until_ = 0;
};

// Holds the rules for column commands of a channel. Its ranks share the data bus.
class ColumnRules {
 public:
  explicit ColumnRules(const Parameters& p) : groups_(p.groups), ranks_(p.ranks) {
    for (auto& from : from_) from.assign(p.groups * p.ranks, 0);
  }
  std::int64_t from(bool write, int rank, int group) const {
    return from_[write ? 1 : 0][rank * groups_ + group];
  }
  void issued(bool write, int rank, int group, std::int64_t now, const Parameters& p) {
    const int read_data = p.cl + p.read_more, write_data = p.cwl + p.write_more;
    for (int r = 0; r < ranks_; ++r)
      for (int g = 0; g < groups_; ++g) {
        const bool same_rank = r == rank, same_group = same_rank && g == group;
        const int apart = p.beats() + p.rank_switch;
        const int in_group = write ? p.ccd_l_write : p.ccd_l;
        const int same_kind = same_rank ? (same_group ? in_group : p.ccd_s) : apart;
        int other_kind = 0;
        if (!write)
          other_kind = read_data - write_data + p.beats() +
                       (same_rank ? p.read_to_write : std::max(p.read_to_write, p.rank_switch));
        else
          other_kind = same_rank ? write_data + p.beats() + (same_group ? p.wtr_l : p.wtr_s)
                                 : std::max(1, write_data - read_data + apart);
        const std::size_t i = r * groups_ + g;
        from_[write ? 1 : 0][i] = std::max(from_[write ? 1 : 0][i], now + same_kind);
        from_[write ? 0 : 1][i] = std::max(from_[write ? 0 : 1][i], now + other_kind);
      }
  }

 private:
  int groups_, ranks_;
  std::array<std::vector<std::int64_t>, 2> from_;  // reads, writes
};

}  // namespace voxmelt::hwmodel::memory
