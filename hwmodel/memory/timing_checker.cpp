#include "hwmodel/memory/timing_checker.h"

#include <algorithm>
#include <iterator>

namespace voxmelt::hwmodel::memory {
namespace {

using Kind = Command::Kind;

// A refresh may be late, and eight intervals may be saved up (JESD79-4, "Refresh Command").
constexpr int kMostPostponed = 8;

bool is_column(Kind kind) { return kind == Kind::read || kind == Kind::write; }

std::string words(Kind kind) {
  switch (kind) {
    case Kind::activate:
      return "ACT";
    case Kind::precharge:
      return "PRE";
    case Kind::precharge_all:
      return "PREA";
    case Kind::read:
      return "RD";
    case Kind::write:
      return "WR";
    case Kind::refresh_bank:
      return "REFB";
    case Kind::refresh:
      break;
  }
  return "REF";
}

}  // namespace

TimingChecker::TimingChecker(const Parameters& parameters) : sheet_(parameters) {
  Rank rank;
  rank.groups.resize(sheet_.groups);
  rank.banks.resize(rank.groups.size() * sheet_.banks);
  Channel channel;
  channel.ranks.assign(sheet_.ranks, rank);
  channels_.assign(sheet_.channels, channel);
}

void TimingChecker::must(const char* rule, bool holds, const Command& c) {
  if (holds) return;
  ++violations_;
  ++by_rule_[rule];
  if (first_.empty())
    first_ = std::string(rule) + ": " + words(c.kind) + " in cycle " + std::to_string(c.cycle) +
             ", channel " + std::to_string(c.channel) + ", rank " + std::to_string(c.rank) + ", group " +
             std::to_string(c.group) + ", bank " + std::to_string(c.bank) + ", row " + std::to_string(c.row);
}

void TimingChecker::at_least(const char* rule, std::int64_t from, int cycles, const Command& c) {
  must(rule, c.cycle - from >= cycles, c);
}

TimingChecker::Bank& TimingChecker::bank_of(Rank& rank, const Command& c) {
  return rank.banks[c.group * sheet_.banks + c.bank];
}

void TimingChecker::issued(const Command& c) {
  ++commands_;
  Channel& channel = channels_[c.channel];
  Rank& rank = channel.ranks[c.rank];
  check_bus(channel, c);
  if (c.kind != Kind::precharge && c.kind != Kind::precharge_all)
    at_least("tRFC", rank.refresh, sheet_.rfc, c);
  switch (c.kind) {
    case Kind::activate:
      check_activate(rank, c);
      break;
    case Kind::read:
    case Kind::write:
      check_column(channel, rank, c);
      break;
    case Kind::precharge: {
      Bank& bank = bank_of(rank, c);
      check_distance(rank, c);
      check_precharge(bank, c);
      bank.open = bank.closed_with_all = false;
      bank.precharge = c.cycle;
      break;
    }
    case Kind::precharge_all:
      check_distance(rank, c);
      for (Bank& bank : rank.banks) {
        if (bank.open) check_precharge(bank, c);
        bank.open = false;
        bank.closed_with_all = true;
        bank.precharge = c.cycle;
      }
      break;
    case Kind::refresh:
      check_refresh(rank, c);
      break;
    case Kind::refresh_bank:
      check_bank_refresh(rank, c);
      break;
  }
}

void TimingChecker::check_bus(Channel& channel, const Command& c) {
  std::int64_t& until = channel.bus_until[sheet_.two_buses && is_column(c.kind) ? 1 : 0];
  must("command bus", c.cycle >= until, c);
  const int slots = c.kind == Kind::activate                                  ? sheet_.act_slots
                    : c.kind == Kind::refresh || c.kind == Kind::refresh_bank ? sheet_.ref_slots
                    : is_column(c.kind)                                       ? sheet_.column_slots
                                                                              : sheet_.pre_slots;
  until = c.cycle + slots;
}

void TimingChecker::check_activate(Rank& rank, const Command& c) {
  Bank& bank = bank_of(rank, c);
  must("ACT of an open bank", !bank.open, c);
  must("row", c.row >= 0 && c.row < sheet_.rows, c);
  at_least("tRFC of a bank", bank.refresh, sheet_.rfc_bank, c);
  at_least("REFB to ACT", rank.bank_refresh, sheet_.ref_to_act, c);
  at_least("tRC", bank.activate, sheet_.rc, c);
  at_least("tRP", bank.precharge, bank.closed_with_all ? sheet_.rp_all : sheet_.rp, c);
  for (int g = 0; g < std::ssize(rank.groups); ++g) {
    const bool same = g == c.group;
    at_least(same ? "tRRD_L" : "tRRD_S", rank.groups[g].activate, same ? sheet_.rrd_l : sheet_.rrd_s, c);
  }
  at_least("tFAW", rank.activates[3], sheet_.faw, c);
  std::rotate(rank.activates.begin(), rank.activates.begin() + 3, rank.activates.end());
  rank.activates[0] = c.cycle;
  rank.groups[c.group].activate = c.cycle;
  bank.open = true;
  bank.row = c.row;
  bank.activate = c.cycle;
}

void TimingChecker::check_precharge(const Bank& bank, const Command& c) {
  at_least("tRAS", bank.activate, sheet_.ras, c);
  at_least("tRTP", bank.read, sheet_.rtp, c);
  at_least("tWR", bank.write,
           sheet_.cwl + sheet_.write_more + sheet_.transfers / sheet_.data_rate + sheet_.wr, c);
}

// Looks back to the last command that closed a bank, of any bank of the rank.
void TimingChecker::check_distance(Rank& rank, const Command& c) {
  at_least("tPPD", rank.precharge, sheet_.ppd, c);
  rank.precharge = c.cycle;
}

void TimingChecker::check_column(Channel& channel, Rank& rank, const Command& c) {
  Bank& bank = bank_of(rank, c);
  must("column of a closed bank", bank.open, c);
  must("column of another row", !bank.open || bank.row == c.row, c);
  must("column", c.column >= 0 && c.column + sheet_.transfers <= sheet_.columns, c);
  at_least("tRCD", bank.activate, sheet_.rcd, c);
  const bool read = c.kind == Kind::read;
  for (int g = 0; g < std::ssize(rank.groups); ++g) {
    const Group& group = rank.groups[g];
    const bool same = g == c.group;
    const int same_group = read ? sheet_.ccd_l : sheet_.ccd_l_write;
    at_least(!same  ? "tCCD_S"
             : read ? "tCCD_L"
                    : "tCCD_L_WR",
             read ? group.read : group.write, same ? same_group : sheet_.ccd_s, c);
    if (!read) continue;
    // The time counts from the end of the written data.
    const int data = sheet_.cwl + sheet_.write_more + sheet_.transfers / sheet_.data_rate;
    at_least(same ? "tWTR_L" : "tWTR_S", group.write, data + (same ? sheet_.wtr_l : sheet_.wtr_s), c);
  }
  check_data(channel, c);
  Group& group = rank.groups[c.group];
  (read ? group.read : group.write) = c.cycle;
  (read ? bank.read : bank.write) = c.cycle;
}

// Checks when data lie on the bus, and how long it must rest between two of them.
void TimingChecker::check_data(Channel& channel, const Command& c) {
  const bool write = c.kind == Kind::write;
  const std::int64_t begin =
      c.cycle + (write ? sheet_.cwl + sheet_.write_more : sheet_.cl + sheet_.read_more);
  must("data bus", begin >= channel.data_until, c);
  if (channel.data_of_rank >= 0) {
    if (write && !channel.data_of_write)
      must("read to write", begin - channel.data_until >= sheet_.read_to_write, c);
    if (channel.data_of_rank != c.rank)
      must("rank switch", begin - channel.data_until >= sheet_.rank_switch, c);
  }
  channel.data_until = begin + sheet_.transfers / sheet_.data_rate;
  channel.data_of_write = write;
  channel.data_of_rank = c.rank;
}

bool TimingChecker::enough_refreshes(const Rank& rank, std::int64_t cycle) const {
  if (!sheet_.by_bank) return rank.refreshes + kMostPostponed >= cycle / sheet_.refi;
  const std::int64_t round = sheet_.banks_of_rank() / sheet_.groups_at_once;
  return rank.bank_refreshes + kMostPostponed * round >= cycle / sheet_.refi_bank;
}

// One command refreshes a bank of the named group, and those of the groups that differ from it in the highest
// bits only. No bank is refreshed again before all have been (JESD209-4, "Refresh command").
void TimingChecker::check_bank_refresh(Rank& rank, const Command& c) {
  must("REFB of a sheet without it", sheet_.by_bank, c);
  if (!sheet_.by_bank) return;
  at_least("REFB to REFB", rank.bank_refresh, sheet_.ref_to_ref, c);
  at_least("tFAW", rank.activates[3], sheet_.faw, c);
  std::int64_t fewest = rank.banks.front().refreshes;
  for (const Bank& bank : rank.banks) fewest = std::min(fewest, bank.refreshes);
  const int low_bits = sheet_.groups / sheet_.groups_at_once - 1;
  for (int g = 0; g < sheet_.groups; ++g) {
    const bool refreshed = (g & low_bits) == (c.group & low_bits);
    at_least("tRRD before REFB", rank.groups[g].activate, refreshed ? sheet_.rrd_l : sheet_.rrd_s, c);
    if (!refreshed) continue;
    Bank& bank = rank.banks[g * sheet_.banks + c.bank];
    must("REFB of an open bank", !bank.open, c);
    must("REFB: its turn", bank.refreshes == fewest, c);
    at_least("tRP before REFB", bank.precharge, bank.closed_with_all ? sheet_.rp_all : sheet_.rp, c);
    at_least("tRC before REFB", bank.activate, sheet_.rc, c);
    at_least("tRFC of a bank", bank.refresh, sheet_.rfc_bank, c);
    bank.refresh = c.cycle;
    ++bank.refreshes;
  }
  rank.bank_refresh = c.cycle;
  ++rank.bank_refreshes;
  must("tREFI: how many", enough_refreshes(rank, c.cycle), c);
  std::rotate(rank.activates.begin(), rank.activates.begin() + 3, rank.activates.end());
  rank.activates[0] = c.cycle;
}

void TimingChecker::check_refresh(Rank& rank, const Command& c) {
  for (const Bank& bank : rank.banks) {
    must("REF with an open bank", !bank.open, c);
    at_least("tRP before REF", bank.precharge, bank.closed_with_all ? sheet_.rp_all : sheet_.rp, c);
    at_least("tRC before REF", bank.activate, sheet_.rc, c);
  }
  const std::int64_t before = std::max<std::int64_t>(rank.refresh, 0);
  must("tREFI: the gap", c.cycle - before <= std::int64_t{kMostPostponed + 1} * sheet_.refi, c);
  rank.refresh = c.cycle;
  ++rank.refreshes;
  must("tREFI: how many", enough_refreshes(rank, c.cycle), c);
}

void TimingChecker::finish(std::int64_t cycle) {
  Command end;
  end.cycle = cycle;
  end.kind = Kind::refresh;
  for (Channel& channel : channels_)
    for (Rank& rank : channel.ranks) {
      must("tREFI: how many", enough_refreshes(rank, cycle), end);
    }
}

}  // namespace voxmelt::hwmodel::memory
