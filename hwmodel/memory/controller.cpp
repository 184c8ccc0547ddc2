#include "hwmodel/memory/controller.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace voxmelt::hwmodel::memory {
namespace {

constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();

}  // namespace

Controller::Controller(const Parameters& parameters, const Policy& policy, int channel)
    : parameters_(parameters),
      policy_(policy),
      channel_(channel),
      ranks_(parameters.ranks, RankState(parameters)),
      columns_(parameters) {
  reads_.reserve(policy.reads);
  writes_.reserve(policy.writes);
  // Ranks are refreshed one after the other.
  const int interval = parameters.by_bank ? parameters.refi_bank : parameters.refi;
  for (int r = 0; r < parameters.ranks; ++r) ranks_[r].due = interval - r * interval / parameters.ranks;
}

bool Controller::has_room(bool write) const {
  return write ? std::ssize(writes_) < policy_.writes : std::ssize(reads_) < policy_.reads;
}

bool Controller::must_wait(std::int64_t address, bool write) {
  const auto same = [&](const Entry& entry) { return entry.address == address; };
  if (std::any_of(writes_.begin(), writes_.end(), same)) {
    hurry_ = true;
    return true;
  }
  return write && std::any_of(reads_.begin(), reads_.end(), same);
}

void Controller::take(const Entry& entry, std::int64_t now) {
  if (empty()) account_.first_waits(now);
  Queue& queue = entry.write ? writes_ : reads_;
  queue.push_back(entry);
  queue.back().arrival = now;
  queue.back().left = parameters_.columns_of_request();
}

std::size_t Controller::bank_of(const Location& at) const {
  return (at.rank * parameters_.groups + at.group) * parameters_.banks + at.bank;
}

void Controller::tell(std::int64_t now, Command::Kind kind, const Location& at) const {
  if (listener_ != nullptr)
    listener_->issued({now, kind, channel_, at.rank, at.group, at.bank, at.row, at.column});
}

std::int64_t Controller::step(std::int64_t now, Done& done) {
  std::int64_t next = kFar;
  // A column command of another bank may come in the same cycle as a refresh of banks, on a bus of its own.
  const bool refreshed = refresh(now, next);
  if (refreshed && !parameters_.by_bank) return now + 1;
  choose_side(now, next);
  if (empty()) return refreshed ? now + 1 : next;
  bool issued = !active().empty() && column(now, next, done);
  issued |= row(now, next);
  return issued || refreshed ? now + 1 : next;
}

void Controller::choose_side(std::int64_t now, std::int64_t& next) {
  const std::int64_t reads = reads_.size(), writes = writes_.size(), low = policy_.low;
  const bool may_turn = run_ >= policy_.batch;
  if (writing_) {
    if (writes != 0 && (hurry_ || reads == 0 || (writes > low && !may_turn))) return;
    writing_ = false;
    run_ = 0;
    no_reads_since_ = now;
    return;
  }
  if (writes == 0) return;
  const std::int64_t too_old = writes_.front().arrival + policy_.starve + 1;
  const std::int64_t lingered = no_reads_since_ + policy_.linger;
  const bool many = writes >= policy_.high || now >= too_old;
  if (hurry_ || (reads != 0 ? many && may_turn : many || writes > low || now >= lingered)) {
    writing_ = true;
    run_ = 0;
  } else
    next = std::min(next, reads == 0 ? lingered : std::max(too_old, now + 1));
}

bool Controller::column(std::int64_t now, std::int64_t& next, Done& done) {
  Queue& queue = active();
  std::int64_t& bus = bus_free_[parameters_.two_buses ? 1 : 0];
  const bool starving = starves(queue.front(), now);
  const std::size_t owned = bank_of(queue.front().at);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    Entry& entry = queue[i];
    BankState& bank = ranks_[entry.at.rank].bank(entry.at.group, entry.at.bank);
    if (bank.open != entry.at.row || bank.closing) continue;
    if (starving && i != 0 && bank_of(entry.at) == owned) continue;
    const std::int64_t from =
        std::max({bank.column, columns_.from(entry.write, entry.at.rank, entry.at.group), bus});
    if (now < from) {
      next = std::min(next, from);
      continue;
    }
    const Parameters& p = parameters_;
    columns_.issued(entry.write, entry.at.rank, entry.at.group, now, p);
    bus = now + p.column_slots;
    const int latency = entry.write ? p.cwl + p.write_more : p.cl + p.read_more;
    const std::int64_t end = now + latency + p.beats();
    bank.precharge = std::max(bank.precharge, entry.write ? end + p.wr : now + p.rtp);
    if (bank.refreshed) account_.refreshed();
    bank.refreshed = false;
    account_.column(now + latency, p.beats(), latency, entry.write, entry.at.rank, entry.activated, counts_);
    ++counts_.columns;
    Location at = entry.at;
    at.column += (p.columns_of_request() - entry.left) * p.transfers;
    tell(now, entry.write ? Command::Kind::write : Command::Kind::read, at);
    if (--entry.left > 0) return true;
    ++run_;
    ++(entry.write ? counts_.writes : counts_.reads);
    ++(entry.precharged ? counts_.conflicts : entry.activated ? counts_.misses : counts_.hits);
    done = {true, entry, entry.write ? now : end + p.interface_cycles};
    if (entry.write) hurry_ = false;
    queue.erase(queue.begin() + i);
    if (reads_.empty() && !done.entry.write) no_reads_since_ = now;
    return true;
  }
  return false;
}

// Issues a row command for the oldest request of each bank. A row with a request that would hit it stays
// open, unless the oldest request of all starves. Banks that this side leaves alone are made ready for the
// other side.
bool Controller::row(std::int64_t now, std::int64_t& next) {
  std::uint64_t seen = 0;
  const bool starving = !active().empty() && starves(active().front(), now);
  if (row_of(active(), starving, seen, now, next)) return true;
  return row_of(writing_ ? reads_ : writes_, false, seen, now, next);
}

bool Controller::row_of(Queue& queue, bool starving, std::uint64_t& seen, std::int64_t now,
                        std::int64_t& next) {
  std::uint64_t hit = 0;
  for (const Entry& entry : queue) {
    BankState& bank = ranks_[entry.at.rank].bank(entry.at.group, entry.at.bank);
    if (bank.open == entry.at.row) hit |= std::uint64_t{1} << bank_of(entry.at);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    Entry& entry = queue[i];
    const std::uint64_t bit = std::uint64_t{1} << bank_of(entry.at);
    if ((seen & bit) != 0) continue;
    seen |= bit;
    RankState& rank = ranks_[entry.at.rank];
    BankState& bank = rank.bank(entry.at.group, entry.at.bank);
    if (bank.closing || bank.open == entry.at.row) continue;
    if ((hit & bit) != 0 && !(starving && i == 0)) continue;
    const bool close = bank.open >= 0;
    const std::int64_t from =
        std::max(bus_free_[0],
                 close ? rank.may_precharge(bank) : rank.may_activate(bank, entry.at.group, parameters_));
    if (now < from) {
      next = std::min(next, from);
      continue;
    }
    if (close) {
      rank.precharge(bank, now, parameters_.rp, parameters_);
      entry.precharged = true;
      ++counts_.precharges;
    } else {
      rank.activate(bank, entry.at.group, entry.at.row, now, parameters_);
      entry.activated = true;
      ++counts_.activates;
    }
    bus_free_[0] = now + (close ? parameters_.pre_slots : parameters_.act_slots);
    tell(now, close ? Command::Kind::precharge : Command::Kind::activate, entry.at);
    return true;
  }
  return false;
}

Counts Controller::counts(std::int64_t now) const {
  Counts counts = counts_;
  counts.held = held;
  for (const RankState& rank : ranks_) counts.active += rank.active(now);
  counts.idle += std::max<std::int64_t>(0, now - account_.end());
  return counts;
}

}  // namespace voxmelt::hwmodel::memory
