// Cache and fetch are tested alone. The cache is compared with lists that keep the last used line in front,
// the fetch with a plain reading of the same places, in the order of the requests.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <list>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/cache.h"
#include "hwmodel/caster/model/gather.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {
namespace {

TEST(RaycastCache, HitsAndMissesAreThoseOfLists) {
  for (const auto& [sets, ways] :
       {std::pair{1, 1}, std::pair{1, 4}, std::pair{8, 1}, std::pair{4, 2}, std::pair{16, 4}}) {
    Cache cache({sets, ways, 4, 64});
    std::vector<std::list<std::int64_t>> lists(static_cast<std::size_t>(sets));
    std::map<std::int64_t, int> slots;  // lines that have a tag
    std::mt19937 random(31);
    std::int64_t misses = 0;
    for (int n = 0; n < 20000; ++n) {
      const std::int64_t line = random() % static_cast<unsigned>(3 * sets * ways + 1);
      // The set is the exclusive or of the line's lowest three digits.
      std::list<std::int64_t>& list =
          lists[static_cast<std::size_t>((line % sets) ^ (line / sets % sets) ^ (line / sets / sets % sets))];
      const auto at = std::find(list.begin(), list.end(), line);
      const bool hit = at != list.end();
      ASSERT_EQ(cache.holds(line), hit);
      if (n % 97 == 0 && hit) {
        cache.forget(line);
        list.erase(at);
        slots.erase(line);
        ASSERT_FALSE(cache.holds(line));
        continue;
      }
      ASSERT_TRUE(cache.has_room());
      const Cache::Found found = cache.look_up(line);
      ASSERT_EQ(found.hit, hit) << n;
      if (hit) {
        list.erase(at);
        ASSERT_EQ(found.slot, slots[line]);
      } else {
        ++misses;
        if (list.size() == static_cast<std::size_t>(ways)) {
          ASSERT_EQ(found.lost, slots[list.back()]) << "the line that was used longest ago loses its tag";
          slots.erase(list.back());
          list.pop_back();
          cache.release(found.lost);
        } else {
          ASSERT_EQ(found.lost, -1);
        }
        for (const auto& [other, slot] : slots)
          ASSERT_NE(found.slot, slot) << "is still the slot of " << other;
        slots[line] = found.slot;
      }
      list.push_front(line);
    }
    EXPECT_EQ(cache.counts().misses, misses);
    EXPECT_GT(misses, 1000);
    cache.clear();
    for (const auto& [line, slot] : slots) EXPECT_FALSE(cache.holds(line));
  }
}

// A slot that lost its tag gives no room before it is released.
TEST(RaycastCache, ALostLineKeepsItsSlotUntilItIsGivenBack) {
  Cache cache({1, 2, 2, 4});
  std::vector<int> lost;
  for (std::int64_t line = 0; line < 4; ++line) {
    ASSERT_TRUE(cache.has_room());
    const Cache::Found found = cache.look_up(line);
    if (found.lost >= 0) lost.push_back(found.lost);
  }
  EXPECT_EQ(lost.size(), 2U);
  EXPECT_FALSE(cache.has_room());
  cache.release(lost[0]);
  ASSERT_TRUE(cache.has_room());
  EXPECT_EQ(cache.look_up(9).slot, lost[0]);
}

struct Ask {
  Places p;
  int number = 0, kind = 0;
  std::size_t kind_index() const { return static_cast<std::size_t>(kind); }
  Places places() const { return p; }
};
using Word = std::uint16_t;
using TestGather = Gather<Ask, Word, 27>;
constexpr Word kAbsent = 9;

// Holds a volume of bricks. Every third one is stored, with a word of its own in each place.
struct World {
  explicit World(bool apron, int bits) {
    layout.sparse = true;
    layout.apron = apron;
    layout.word_bytes = sizeof(Word);
    layout.bits = {bits, bits, bits};
    layout.count = {3, 3, 3};
    const int words = apron ? 11 * 11 * 11 : 1 << (3 * bits);
    layout.line_bytes = (words * layout.word_bytes + 63) / 64 * 64;
    layout.slots.resize(27);
    int next = 0;
    for (std::size_t i = 0; i < 27; ++i) layout.slots[i] = i % 3 == 1 ? 0 : ++next;
    const std::int64_t lines = (next + 1) * (apron ? 1 : std::int64_t{1} << (3 * (3 - bits)));
    layout.base = 128;
    bytes.resize(static_cast<std::size_t>(layout.base + lines * layout.line_bytes));
    for (int bz = 0; bz < 3; ++bz)
      for (int by = 0; by < 3; ++by)
        for (int bx = 0; bx < 3; ++bx)
          if (stored(bx, by, bz)) fill(bx, by, bz);
  }
  bool stored(int bx, int by, int bz) const {
    return layout.slots[static_cast<std::size_t>((bz * 3 + by) * 3 + bx)] != 0;
  }
  static Word number(int x, int y, int z) { return static_cast<Word>(1000 + (z * 24 + y) * 24 + x); }
  void put(std::int64_t address, Word word) { std::memcpy(bytes.data() + address, &word, sizeof word); }
  void fill(int bx, int by, int bz) {
    const int low = layout.apron ? -1 : 0, high = layout.apron ? 10 : 8;
    for (int z = low; z < high; ++z)
      for (int y = low; y < high; ++y)
        for (int x = low; x < high; ++x) {
          const int px = 8 * bx + x, py = 8 * by + y, pz = 8 * bz + z;
          if (layout.apron) {
            const std::int64_t at =
                layout.base + layout.slots[static_cast<std::size_t>((bz * 3 + by) * 3 + bx)] *
                                  std::int64_t{layout.line_bytes};
            put(at + 2 * (((z + 1) * 11 + y + 1) * 11 + x + 1), number(px, py, pz));
          } else {
            const int bits = layout.bits[0], side = 1 << bits, more = 8 / side;
            const std::int64_t line =
                std::int64_t{layout.slots[static_cast<std::size_t>((bz * 3 + by) * 3 + bx)]} * more * more *
                    more +
                ((z / side) * more + y / side) * more + x / side;
            put(layout.base + line * layout.line_bytes +
                    2 * (((z % side) * side + y % side) * side + x % side),
                number(px, py, pz));
          }
        }
  }
  // With aprons the whole request is served by the brick of its low place.
  Word expected(const Places& p, int x, int y, int z) const {
    const bool is =
        layout.apron ? stored(p.low[0] / 8, p.low[1] / 8, p.low[2] / 8) : stored(x / 8, y / 8, z / 8);
    return is ? number(x, y, z) : kAbsent;
  }
  Layout layout;
  std::vector<std::uint8_t> bytes;
};

struct Fetched {
  std::int64_t cycles = 0, misses = 0;
};

// The memory answers after `latency` cycles, channels stall, and requests have two and three places a side.
Fetched run(const World& world, const CacheShape& shape, std::uint64_t stall_seed, int latency, int count) {
  TestGather gather("words", shape, world.layout, 3, kAbsent, 5);
  Fifo<Ask> in("in", 0, 1, 2, stall_seed);
  Fifo<LineRequest> ask("ask", 1, 1, 2, stall_seed);
  Fifo<TestGather::Out> two("two", 2, 1, 2, stall_seed), three("three", 3, 1, 2, stall_seed);
  gather.connect(in, ask);
  gather.connect_out({&two, &three});
  struct Reply {
    std::int64_t due;
    LineReply reply;
  };
  std::deque<Reply> under_way;
  std::deque<Ask> asked;
  std::mt19937 random(41);
  Fetched fetched;
  int put = 0, got = 0;
  int x = 9, y = 9, z = 9;
  for (; got < count && fetched.cycles < 400000; ++fetched.cycles) {
    for (Fifo<TestGather::Out>* out : {&two, &three}) {
      if (!out->valid()) continue;
      const TestGather::Out& answer = *out->get();
      const auto same = std::find_if(asked.begin(), asked.end(),
                                     [&](const Ask& a) { return a.kind == answer.request.kind; });
      EXPECT_NE(same, asked.end());
      if (same == asked.end()) return fetched;
      EXPECT_EQ(answer.request.number, same->number) << "in order";
      const Places& p = same->p;
      const auto side = static_cast<std::size_t>(p.side);
      for (std::size_t i = 0; i < side * side * side; ++i)
        EXPECT_EQ(answer.words[i],
                  world.expected(p, p.x[i % side], p.y[i / side % side], p.z[i / side / side]))
            << got << " " << i;
      if (testing::Test::HasFailure()) return fetched;
      asked.erase(same);
      ++got;
    }
    if (!under_way.empty() && under_way.front().due <= fetched.cycles) {
      const LineReply& reply = under_way.front().reply;
      EXPECT_EQ(reply.client, 3);
      gather.arrived(reply, world.bytes.data() + reply.address);
      under_way.pop_front();
    }
    if (ask.valid()) {
      const LineRequest& request = *ask.get();
      EXPECT_FALSE(request.write);
      EXPECT_EQ(request.bytes, world.layout.line_bytes);
      under_way.push_back(
          {fetched.cycles + latency, {request.client, request.slot, request.address, request.bytes}});
    }
    gather.data.run();
    gather.tags.run();
    if (put < count && in.ready()) {
      // A request is near the one before, as samples of a ray are, and now and then somewhere else.
      const auto walk = [&](int at) { return std::clamp(at + static_cast<int>(random() % 3) - 1, 1, 20); };
      x = walk(x);
      y = walk(y);
      z = walk(z);
      const auto anywhere = [&] { return 1 + static_cast<int>(random() % 20); };
      if (random() % 20 == 0) {
        x = anywhere();
        y = anywhere();
        z = anywhere();
      }
      Ask& next = *in.put();
      next = {};
      next.number = put++;
      next.kind = random() % 4 == 0 ? 1 : 0;
      next.p.side = next.p.high = next.kind == 1 ? 3 : 2;
      next.p.low = {x, y, z};
      const int from = next.kind == 1 ? -1 : 0;
      const auto places = [&](int at) {
        return std::array<std::int32_t, 4>{at + from, at + from + 1, at + from + 2, 0};
      };
      next.p.x = places(x);
      next.p.y = places(y);
      next.p.z = places(z);
      asked.push_back(next);
    }
    in.commit();
    ask.commit();
    two.commit();
    three.commit();
  }
  EXPECT_EQ(got, count) << "it hangs";
  fetched.misses = gather.counts().misses;
  return fetched;
}

TEST(RaycastGather, WordsAreThoseOfAPlainReadingInTheirOrder) {
  for (const bool apron : {false, true})
    for (const int bits : {apron ? 3 : 1, apron ? 3 : 2, 3})
      for (const CacheShape& shape : {CacheShape{1, 1, 8, 1}, CacheShape{1, 8, 8, 4}, CacheShape{4, 2, 8, 64},
                                      CacheShape{16, 4, 8, 64}})
        for (const std::uint64_t seed : {0, 5})
          for (const int latency : {1, 40}) {
            run(World(apron, bits), shape, seed, latency, 300);
            if (HasFailure())
              FAIL() << "apron " << apron << " bits " << bits << " sets " << shape.sets << " seed " << seed;
          }
}

// A larger cache misses less; a queue between tags and data hides the memory.
TEST(RaycastGather, SizeAndQueueDoWhatTheyAreFor) {
  const World world(false, 2);
  const Fetched small = run(world, {2, 2, 8, 64}, 0, 40, 2000),
                large = run(world, {64, 8, 8, 64}, 0, 40, 2000);
  EXPECT_LT(4 * large.misses, small.misses);
  const Fetched narrow = run(world, {2, 2, 8, 1}, 0, 40, 2000);
  EXPECT_EQ(narrow.misses, small.misses);  // the order of lookups is the same
  EXPECT_LT(2 * small.cycles, narrow.cycles);
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
