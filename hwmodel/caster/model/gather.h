// A gather fetches the words of a small box of places through a cache: two to four places along an axis. A
// place of a volume lies in bank (x + 2 y + 4 z) mod 8. So the eight words of two places a side lie in eight
// banks, and the 27 words of three in no bank more than five times. Columns have 16 banks, (x mod 4) + 4 (z
// mod 4), and four by four of them come at once. There are two stages: tags, and behind a queue data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/cache.h"
#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

// A request to the memory asks for a line, or writes a burst.
struct LineRequest {
  int client = 0, slot = 0;  // client and slot that get the line
  std::int64_t address = 0;
  int bytes = 0;
  bool write = false;
  std::array<std::uint8_t, kBurst> data{};  // data of a write
};
// A reply from the memory says that a line has come.
struct LineReply {
  int client = 0, slot = 0;
  std::int64_t address = 0;
  int bytes = 0;
};

// Names the places that a request reads, and the one by which a brick with its apron is found.
struct Places {
  std::array<std::int32_t, 4> x{}, y{}, z{};
  int side = 2;  // places along x and z
  std::array<std::int32_t, 3> low{};
  int high = 2;  // places along y
};

template <class Request, class Word, std::size_t kMost>
struct Gathered {
  Request request;
  std::array<Word, kMost> words;
};

// Receives lines from the memory.
class LineClient {
 public:
  virtual ~LineClient() = default;
  virtual void arrived(const LineReply& reply, const std::uint8_t* bytes) = 0;
};

// A Request says which places it reads, and to which channel the answer goes.
template <class Request, class Word, std::size_t kMost, class Faults = NoFaults>
class Gather final : public LineClient {
 public:
  using Out = Gathered<Request, Word, kMost>;
  // `cycles` is the time that three places a side take.
  Gather(const std::string& name, const CacheShape& shape, const Layout& layout, int client, Word absent,
         int cycles, Faults faults = {})
      : tags(name + " tags", *this),
        data(name + " data", *this),
        layout_(layout),
        faults_(faults),
        client_(client),
        absent_(absent),
        cycles_(cycles),
        cache_(shape),
        arrived_(shape.lines() + shape.spare, 0),
        store_(arrived_.size() * layout.line_bytes),
        queue_(shape.queue) {}

  void connect(Fifo<Request>& in, Fifo<LineRequest>& to_memory) {
    in_ = &in;
    to_memory_ = &to_memory;
  }
  // Requests of kind i go to channel i.
  void connect_out(std::vector<Fifo<Out>*> out) { out_ = std::move(out); }

  void arrived(const LineReply& reply, const std::uint8_t* bytes) override {
    const std::size_t slot = reply.slot;
    // The line may be meant for another cache, which a checker tells. Then this one may have no such slot, or
    // none at all.
    if (slot >= arrived_.size() || store_.empty()) return;
    if (faults_.keeps_old_line()) [[unlikely]] {
      arrived_[slot] = 1;
      return;
    }
    std::memcpy(store_.data() + slot * line_bytes(), bytes, line_bytes());
    faults_.came(store_.data() + slot * line_bytes(), line_bytes());
    arrived_[slot] = 1;
  }
  const CacheCounts& counts() const { return cache_.counts(); }
  // The host calls these when the memory has new contents.
  void forget_all() { cache_.clear(); }
  void forget(std::int64_t line) { cache_.forget(line); }

 private:
  struct Tags final : Stage {
    Tags(std::string name, Gather& gather) : Stage(std::move(name)), gather_(gather) {}
    Did cycle() override { return gather_.look_up(); }
    Gather& gather_;
  };
  struct Data final : Stage {
    Data(std::string name, Gather& gather) : Stage(std::move(name)), gather_(gather) {}
    Did cycle() override { return gather_.read(); }
    Gather& gather_;
  };

 public:
  Tags tags;
  Data data;  // is evaluated first

  // A fault policy looks at this, too.
  struct Entry {
    Request request;
    Places places;
    std::array<std::uint8_t, 3> lines{};  // different lines along each axis: 1 or 2
    std::array<std::int32_t, 8> slots{};  // -1 if nothing is stored there
    std::array<std::int32_t, 8> lost{};
  };
  const Layout& layout() const { return layout_; }
  const Cache& cache() const { return cache_; }
  const std::uint8_t* bytes_in(int slot) const {
    return slot < 0 ? nullptr : store_.data() + slot * line_bytes();
  }
  bool has_arrived(int slot) const { return arrived_[slot] != 0; }
  std::int64_t line_of(const Entry& entry, int which) const {
    const Places& p = entry.places;
    if (layout_.apron)
      return layout_.line_at(p.low[0] >> kBrickBits, p.low[1] >> kBrickBits, p.low[2] >> kBrickBits);
    const std::int32_t last = p.side - 1, top = p.high - 1;
    const int ix = which % entry.lines[0], iy = which / entry.lines[0] % entry.lines[1],
              iz = which / entry.lines[0] / entry.lines[1];
    return layout_.line_at(p.x[ix == 0 ? 0 : last] >> layout_.bits[0],
                           p.y[iy == 0 ? 0 : top] >> layout_.bits[1],
                           p.z[iz == 0 ? 0 : last] >> layout_.bits[2]);
  }
  // Line i of the entry is at `bytes_of(i)`, which is null if nothing is stored there.
  template <class BytesOf>
  void read_words(const Entry& entry, const BytesOf& bytes_of, Word* to) const {
    const Places& p = entry.places;
    const std::size_t side = p.side, high = p.high;
    for (std::size_t z = 0; z < side; ++z)
      for (std::size_t y = 0; y < high; ++y)
        for (std::size_t x = 0; x < side; ++x, ++to) {
          std::size_t which = 0;
          int offset = 0;
          if (layout_.apron) {
            offset = layout_.apron_offset(p.x[x], p.y[y], p.z[z], p.low[0] >> kBrickBits,
                                          p.low[1] >> kBrickBits, p.low[2] >> kBrickBits);
          } else {
            const auto beyond = [&](const std::array<std::int32_t, 4>& along, std::size_t i,
                                    std::size_t axis) {
              return (along[i] >> layout_.bits[axis]) == (along[0] >> layout_.bits[axis]) ? 0u : 1u;
            };
            which =
                (beyond(p.z, z, 2) * entry.lines[1] + beyond(p.y, y, 1)) * entry.lines[0] + beyond(p.x, x, 0);
            offset = layout_.offset(p.x[x], p.y[y], p.z[z]);
          }
          const std::uint8_t* bytes = bytes_of(which);
          if (bytes == nullptr)
            *to = absent_;
          else
            std::memcpy(to, bytes + offset, sizeof(Word));
        }
  }

 private:
  std::size_t line_bytes() const { return layout_.line_bytes; }

  Did look_up() {
    if (!in_->valid()) return Did::starved;
    if (count_ == queue_.size()) return Did::blocked;
    Entry& entry = queue_[tail_];
    if (next_ == 0) begin(entry);
    const int all = entry.lines[0] * entry.lines[1] * entry.lines[2];
    bool missed = false;
    for (; next_ < all; ++next_) {
      const std::size_t i = next_;
      const std::int64_t line = line_of(entry, next_);
      entry.lost[i] = -1;
      if (line == kNoLine) {
        entry.slots[i] = -1;
        continue;
      }
      const std::int64_t tag = faults_.tag_of(line);
      const bool hit = cache_.holds(tag);
      if (!hit && (missed || !cache_.has_room() || !to_memory_->ready()))
        return missed ? Did::busy : Did::memory;  // one miss a cycle
      const Cache::Found found = cache_.look_up(tag);
      entry.slots[i] = found.slot;
      if (found.hit) continue;
      missed = true;
      if (found.lost >= 0 && faults_.releases_early()) [[unlikely]]
        cache_.release(found.lost);
      else
        entry.lost[i] = found.lost;
      arrived_[found.slot] = 0;
      if (faults_.loses_miss(entry)) [[unlikely]]
        continue;
      LineRequest& ask = *to_memory_->put();
      ask.client = client_;
      ask.slot = found.slot;
      ask.address = layout_.address(line);
      ask.bytes = layout_.line_bytes;
      ask.write = false;
    }
    in_->get();
    next_ = 0;
    tail_ = after(tail_);
    ++count_;
    return Did::busy;
  }

  void begin(Entry& entry) {
    entry.request = *in_->oldest();
    entry.places = entry.request.places();
    const Places& p = entry.places;
    if (layout_.apron) {
      entry.lines = {1, 1, 1};
      return;
    }
    const auto many = [&](const std::array<std::int32_t, 4>& along, std::size_t axis) {
      const int bits = layout_.bits[axis];
      const std::size_t last = (axis == 1 ? p.high : p.side) - 1;
      return static_cast<std::uint8_t>((along[0] >> bits) == (along[last] >> bits) ? 1 : 2);
    };
    entry.lines = {many(p.x, 0), many(p.y, 1), many(p.z, 2)};
  }
  Did read() {
    if (count_ == 0) return Did::starved;
    Entry& entry = queue_[head_];
    const std::size_t all = entry.lines[0] * entry.lines[1] * entry.lines[2];
    for (std::size_t i = 0; i < all; ++i)
      if (entry.slots[i] >= 0 && !has_arrived(entry.slots[i]) && !faults_.reads_early()) return Did::memory;
    Fifo<Out>& out = *out_[entry.request.kind_index()];
    if (!out.ready()) return Did::blocked;
    if (++reading_ < (entry.places.side == 3 ? cycles_ : 1)) return Did::busy;
    reading_ = 0;
    Out& to = *out.put();
    to.request = entry.request;
    read_words(
        entry, [&](std::size_t which) { return bytes_in(entry.slots[which]); }, to.words.data());
    faults_.fetched(*this, entry, to.words);
    for (std::size_t i = 0; i < all; ++i)
      if (entry.lost[i] >= 0) cache_.release(entry.lost[i]);
    head_ = after(head_);
    --count_;
    return Did::busy;
  }
  std::size_t after(std::size_t i) const { return i + 1 == queue_.size() ? 0 : i + 1; }

  const Layout& layout_;
  [[no_unique_address]] Faults faults_;
  int client_;
  Word absent_;
  int cycles_;
  Cache cache_;
  std::vector<std::uint8_t> arrived_;
  std::vector<std::uint8_t> store_;
  std::vector<Entry> queue_;
  std::size_t head_ = 0, tail_ = 0, count_ = 0;
  int next_ = 0, reading_ = 0;
  Fifo<Request>* in_ = nullptr;
  Fifo<LineRequest>* to_memory_ = nullptr;
  std::vector<Fifo<Out>*> out_;
};

}  // namespace voxmelt::hwmodel::raycast
