// The controller of one channel has two bounded queues. It serves row hits first and then the oldest request,
// and writes in batches. Rows stay open, and refresh comes on time. A request that is too old gets its bank
// for itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/memory/address_map.h"
#include "hwmodel/memory/bus_account.h"
#include "hwmodel/memory/command.h"
#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/parameters.h"
#include "hwmodel/memory/rank_state.h"

namespace voxmelt::hwmodel::memory {

// Describes a request in a queue.
struct Entry {
  std::int64_t address = 0;
  std::int64_t put = 0, arrival = 0;  // cycles of arrival: at its port, in the queue
  Location at;
  bool write = false;
  int left = 0;                                // column commands still to issue
  bool activated = false, precharged = false;  // commands issued for this request
  int port = 0;
  std::uint32_t id = 0;
  std::int64_t number = 0;  // number of a read at its port
};

class Controller {
 public:
  Controller(const Parameters& parameters, const Policy& policy, int channel);

  bool has_room(bool write) const;
  // Returns true if an older request to the same burst waits, and one of the two writes. If the older one is
  // a write, it will be hurried.
  bool must_wait(std::int64_t address, bool write);
  void take(const Entry& entry, std::int64_t now);

  struct Done {
    bool any = false;
    Entry entry;
    std::int64_t at = 0;  // a read: its last byte is at the machine; a write: its column command
  };
  // Issues at most one command on each command bus in cycle `now`. Returns the next cycle in which it can do
  // something if nothing new comes.
  std::int64_t step(std::int64_t now, Done& done);

  bool empty() const { return reads_.empty() && writes_.empty(); }
  Counts counts(std::int64_t now) const;
  void listen(CommandListener* listener) { listener_ = listener; }
  std::int64_t held = 0;

 private:
  using Queue = std::vector<Entry>;

  // These are in refresh.cpp.
  bool refresh(std::int64_t now, std::int64_t& next);
  bool refresh_rank(int rank, std::int64_t now, std::int64_t& next);
  bool refresh_banks(int rank, std::int64_t now, std::int64_t& next);
  void choose_side(std::int64_t now, std::int64_t& next);
  bool column(std::int64_t now, std::int64_t& next, Done& done);
  bool row(std::int64_t now, std::int64_t& next);
  bool row_of(Queue& queue, bool starving, std::uint64_t& seen, std::int64_t now, std::int64_t& next);
  bool starves(const Entry& entry, std::int64_t now) const { return now - entry.arrival > policy_.starve; }
  std::size_t bank_of(const Location& at) const;  // index in the channel
  Queue& active() { return writing_ ? writes_ : reads_; }
  void tell(std::int64_t now, Command::Kind kind, const Location& at) const;

  Parameters parameters_;
  Policy policy_;
  int channel_;
  Queue reads_, writes_;
  bool writing_ = false, hurry_ = false;
  int run_ = 0;  // requests since it turned round
  std::int64_t no_reads_since_ = 0;
  std::vector<RankState> ranks_;
  ColumnRules columns_;
  std::array<std::int64_t, 2> bus_free_{};  // command buses: rows, columns
  BusAccount account_;
  Counts counts_;
  CommandListener* listener_ = nullptr;
};

}  // namespace voxmelt::hwmodel::memory
