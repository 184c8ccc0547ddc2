// The cache is set-associative, and its lines are renamed. A line that a request needs stays readable until
// that request has passed, although a later request has taken its tag.
//
// Tags are looked up ahead, in order. Data are read later, in the same order. Between them a queue hides the
// memory's latency. A miss takes a free slot for the new line at once. The slot of the line that lost its tag
// is free again when the request that took it has read its data.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/layout.h"

namespace voxmelt::hwmodel::raycast {

struct CacheCounts {
  std::int64_t lookups = 0, misses = 0;  // counted in lines
};

class Cache {
 public:
  explicit Cache(const CacheShape& shape)
      : ways_(shape.ways), sets_(shape.sets), set_bits_(std::countr_zero(sets_)), tags_(ways_ * sets_) {
    for (int slot = shape.lines() + shape.spare - 1; slot >= 0; --slot) free_.push_back(slot);
  }

  struct Found {
    bool hit = false;
    int slot = 0;
    int lost = -1;  // slot of the line that lost its tag; to be given back by `release`
  };
  bool holds(std::int64_t line) const {
    const Tag* set = set_of(line);
    for (std::size_t w = 0; w < ways_; ++w)
      if (set[w].line == line) return true;
    return false;
  }
  // Returns the slot of another line of its set, or -1 if there is none.
  int slot_beside(std::int64_t line) const {
    const Tag* set = set_of(line);
    for (std::size_t w = 0; w < ways_; ++w)
      if (set[w].line != kNoLine && set[w].line != line) return set[w].slot;
    return -1;
  }
  bool has_room() const { return !free_.empty(); }
  // Looks up a line. A miss takes a free slot.
  Found look_up(std::int64_t line) {
    Tag* set = set_of(line);
    Tag* oldest = set;
    ++counts_.lookups;
    for (std::size_t w = 0; w < ways_; ++w) {
      if (set[w].line == line) {
        set[w].used = ++clock_;
        return {true, set[w].slot, -1};
      }
      if (set[w].used < oldest->used) oldest = &set[w];
    }
    ++counts_.misses;
    const Found found{false, free_.back(), oldest->line == kNoLine ? -1 : oldest->slot};
    free_.pop_back();
    *oldest = {line, found.slot, ++clock_};
    return found;
  }
  void release(int slot) { free_.push_back(slot); }
  // Forgets a line that has changed in memory.
  void forget(std::int64_t line) {
    Tag* set = set_of(line);
    for (std::size_t w = 0; w < ways_; ++w)
      if (set[w].line == line) {
        free_.push_back(set[w].slot);
        set[w] = {};
      }
  }
  void clear() {
    for (Tag& tag : tags_) {
      if (tag.line != kNoLine) free_.push_back(tag.slot);
      tag = {};
    }
  }
  const CacheCounts& counts() const { return counts_; }

 private:
  struct Tag {
    std::int64_t line = kNoLine;
    int slot = 0;
    std::int64_t used = 0;
  };
  // A line's number is folded, because rows of a dense volume would otherwise all share a few sets.
  std::size_t first_of(std::int64_t line) const {
    const std::size_t number = line;
    return ((number ^ (number >> set_bits_) ^ (number >> (2 * set_bits_))) & (sets_ - 1)) * ways_;
  }
  const Tag* set_of(std::int64_t line) const { return tags_.data() + first_of(line); }
  Tag* set_of(std::int64_t line) { return tags_.data() + first_of(line); }

  std::size_t ways_, sets_;
  int set_bits_;
  std::vector<Tag> tags_;
  std::vector<int> free_;
  std::int64_t clock_ = 0;
  CacheCounts counts_;
};

}  // namespace voxmelt::hwmodel::raycast
