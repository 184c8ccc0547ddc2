// Levels come from the wrong line, way, bank or time. A wrong cache may give the right words for a while. So
// those faults go on until wrong words leave.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hwmodel/caster/faults/planted.h"

namespace voxmelt::hwmodel::raycast {

class FetchFaults : public Planted {
 public:
  using Planted::Planted;

  std::int64_t tag_of(std::int64_t line) const { return armed(Fault::cache_tag_bits) ? line & 4095 : line; }
  bool releases_early() const { return armed(Fault::cache_early_release); }
  bool keeps_old_line() const { return armed(Fault::cache_stale_line); }
  bool reads_early() const { return armed(Fault::cache_reads_early); }
  void came(std::uint8_t* bytes, std::size_t count) const {
    if (count > 0 && armed(Fault::memory_bit)) bytes[0] ^= 1;
  }
  template <class Entry>
  bool loses_miss(const Entry& entry) {
    if (!armed(Fault::cache_lost_miss)) return false;
    strike("levels", entry.request.id);
    return true;
  }

  template <class Gather, class Entry, class Words>
  void fetched(const Gather& gather, const Entry& entry, Words& words) {
    if (plan_strikes_late()) {
      if (!same(entry, words, right(gather, entry))) strike("levels", entry.request.id);
      return;
    }
    Words wrong = words;
    if (armed(Fault::cache_wrong_way)) {
      gather.read_words(
          entry, [&](std::size_t i) { return other_way(gather, entry, i); }, wrong.data());
    } else if (armed(Fault::levels_border)) {
      gather.read_words(
          entry, [&](std::size_t) { return gather.bytes_in(entry.slots[0]); }, wrong.data());
    } else if (armed(Fault::levels_bank_swap)) {
      std::swap(wrong[0], wrong[1]);
    } else {
      return;
    }
    if (same(entry, words, wrong)) return;
    words = wrong;
    strike("levels", entry.request.id);
  }

 private:
  bool plan_strikes_late() const {
    return armed(Fault::cache_tag_bits) || armed(Fault::cache_early_release) ||
           armed(Fault::cache_stale_line) || armed(Fault::cache_reads_early) || armed(Fault::memory_bit);
  }
  template <class Entry, class Words>
  static bool same(const Entry& entry, const Words& a, const Words& b) {
    const int side = entry.places.side;
    return std::equal(a.begin(), a.begin() + side * side * side, b.begin());
  }
  // Returns the words as they lie in memory.
  template <class Gather, class Entry>
  std::array<std::int16_t, 27> right(const Gather& gather, const Entry& entry) const {
    std::array<std::int16_t, 27> words{};
    const auto bytes = [&](std::size_t i) -> const std::uint8_t* {
      const std::int64_t line = gather.line_of(entry, static_cast<int>(i));
      return line == kNoLine ? nullptr : memory().bytes.data() + gather.layout().address(line);
    };
    gather.read_words(entry, bytes, words.data());
    return words;
  }
  template <class Gather, class Entry>
  const std::uint8_t* other_way(const Gather& gather, const Entry& entry, std::size_t i) const {
    const int slot = entry.slots[i];
    if (slot < 0) return nullptr;
    const int other = gather.cache().slot_beside(gather.line_of(entry, static_cast<int>(i)));
    return gather.bytes_in(other >= 0 && gather.has_arrived(other) ? other : slot);
  }
};

}  // namespace voxmelt::hwmodel::raycast
