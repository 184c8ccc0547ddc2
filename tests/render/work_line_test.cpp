// Lines of work keep their order, their room and their errors.
#include "render/frames/work_line.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace voxmelt {
namespace {

using render::WorkLine;
using namespace std::chrono_literals;

TEST(WorkLine, OneThreadKeepsTheOrder) {
  for (const int threads : {0, 1}) {
    std::vector<int> done, expected;
    {
      WorkLine<int> line(threads, 2, [&](int& item) { done.push_back(item); });
      for (int i = 0; i < 200; ++i) {
        line.put(i);
        expected.push_back(i);
      }
      line.wait();
    }
    EXPECT_EQ(done, expected);
  }
}

TEST(WorkLine, EachItemIsWorkedOnce) {
  std::vector<std::atomic<int>> times(500);
  WorkLine<std::size_t> line(4, 3, [&](std::size_t& item) { ++times[item]; });
  for (std::size_t i = 0; i < times.size(); ++i) line.put(i);
  line.wait();
  for (const std::atomic<int>& count : times) EXPECT_EQ(count, 1);
}

// Two threads hold an item each, and three items wait. The sixth put does not return.
TEST(WorkLine, PutWaitsWhileTheLineIsFull) {
  std::atomic<bool> go = false;
  std::atomic<int> put = 0;
  const auto token = std::make_shared<int>(0);  // its count is the number of items in memory
  {
    WorkLine<std::shared_ptr<int>> line(2, 3, [&](std::shared_ptr<int>&) { go.wait(false); });
    std::jthread putter([&] {
      for (int i = 0; i < 20; ++i) {
        line.put(token);
        ++put;
      }
    });
    for (int t = 0; t < 200 && put < 5; ++t) std::this_thread::sleep_for(5ms);
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(put, 5);
    EXPECT_EQ(token.use_count(), 1 + 6);  // five items, and the one that `putter` holds
    go = true;
    go.notify_all();
    putter.join();
    line.wait();
    EXPECT_EQ(token.use_count(), 1) << "what is done holds memory";
  }
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

// Items 3 and 4 fail while both are in work, either of them late. A caller hears of item 3.
TEST(WorkLine, TheFirstErrorInOrderCounts) {
  for (const int late : {3, 4})
    for (const int threads : {0, 1, 3}) {
      std::atomic<int> begun = 0;
      WorkLine<int> line(threads, 8, [&](int& item) {
        ++begun;
        if (item < 3) return;
        while (threads == 3 && begun < 5) std::this_thread::yield();
        if (item == late) std::this_thread::sleep_for(60ms);
        throw std::runtime_error("item " + std::to_string(item));
      });
      std::string heard = "nothing";
      for (int i = 0; i < 1000 && heard == "nothing"; ++i) heard = message_of([&] { line.put(i); });
      EXPECT_EQ(heard, "item 3");
      if (threads == 0) continue;
      EXPECT_EQ(message_of([&] { line.check(); }), "item 3");
      EXPECT_EQ(message_of([&] { line.wait(); }), "item 3");
      EXPECT_EQ(message_of([&] { line.put(0); }), "item 3");
      EXPECT_LE(begun, 3 + threads) << "what waits is dropped";
    }
}

TEST(WorkLine, NothingIsThrownWhereNothingFails) {
  WorkLine<int> line(2, 2, [](int&) {});
  line.put(1);
  EXPECT_EQ(message_of([&] { line.check(); }), "nothing");
  EXPECT_EQ(message_of([&] { line.wait(); }), "nothing");
}

}  // namespace
}  // namespace voxmelt
