// Every task runs once, and its writes are visible when the run ends, whichever thread ran it.
#include "kernel/engine/cpu/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>
#include <numeric>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace voxmelt::cpu {
namespace {

TEST(Workers, EveryTaskOnceAndItsResultThere) {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (int run = 0; run < 3000; ++run) {
      std::vector<int> results(
          static_cast<std::size_t>(run % 70));  // plain memory: the run's end must publish it
      workers.run(static_cast<int>(results.size()),
                  [&](int i) { results[static_cast<std::size_t>(i)] += i + run; });
      for (std::size_t i = 0; i < results.size(); ++i)
        ASSERT_EQ(results[i], static_cast<int>(i) + run) << threads << " threads, run " << run;
    }
  }
}

// A task reads the results of another task of the run before.
TEST(Workers, RunsSeeWhatEarlierRunsWrote) {
  Workers workers(4);
  std::vector<std::int64_t> now(64), next(64);
  std::iota(now.begin(), now.end(), 0);
  std::int64_t sum = 64 * 63 / 2;
  for (int run = 0; run < 5000; ++run) {
    workers.run(64, [&](int i) {
      next[static_cast<std::size_t>(i)] = now[static_cast<std::size_t>(i + 1) % 64] + 1;
    });
    std::swap(now, next);
    sum += 64;
  }
  EXPECT_EQ(std::accumulate(now.begin(), now.end(), std::int64_t{0}), sum);
}

TEST(Workers, WhatATaskThrowsArrives) {
  for (const int threads : {1, 2, 8}) {
    Workers workers(threads);
    for (int run = 0; run < 200; ++run) {
      std::atomic<int> begun{0};
      EXPECT_THROW(workers.run(1000,
                               [&](int) {
                                 ++begun;
                                 throw std::bad_alloc();
                               }),
                   std::bad_alloc);
      EXPECT_LE(begun, threads) << "tasks that were not begun are left out";
    }
    int done = 0;
    workers.run(1, [&](int) { ++done; });
    EXPECT_EQ(done, 1) << "and the workers are as before";
  }
}

TEST(Workers, TwoThreadsRunAtOnce) {
  Workers workers(2);
  for (int round = 0; round < 5; ++round) {
    std::atomic<int> there{0};
    // Two tasks that wait for each other need two threads, or give up.
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    workers.run(2, [&](int) {
      for (++there; there < 2 && std::chrono::steady_clock::now() < give_up;) std::this_thread::yield();
    });
    EXPECT_EQ(there, 2);
    EXPECT_LT(std::chrono::steady_clock::now(), give_up) << "nobody helped";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the next round finds them asleep
  }
}

TEST(Workers, ManyShortLivesAndSeveralAtOnce) {
  for (int round = 0; round < 300; ++round) {
    Workers one(2), other(3);
    std::atomic<int> sum{0};
    one.run(5, [&](int i) { sum += i; });
    other.run(6, [&](int i) { sum += i; });
    ASSERT_EQ(sum, 10 + 15);
  }
  std::atomic<int> sum{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller)
    callers.emplace_back([&sum] {
      Workers own(2);
      for (int run = 0; run < 500; ++run) own.run(4, [&](int i) { sum += i; });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 4 * 500 * 6);
}

// Repeated tasks run once each, and the longest runs first. If their number changes, all count as alike.
TEST(Turns, TheDearestFirst) {
  Turns turns;
  turns.sort(4);
  for (int turn = 0; turn < 4; ++turn) EXPECT_EQ(turns.at(turn), turn);
  const int micros[] = {30, 10, 40, 20};
  for (int task = 0; task < 4; ++task) turns.took(task, std::chrono::microseconds(micros[task]));
  turns.sort(4);
  const int cheapest_first[] = {1, 3, 0, 2};  // Workers begin with the last turn
  for (int turn = 0; turn < 4; ++turn) EXPECT_EQ(turns.at(turn), cheapest_first[turn]);
  turns.took(1, std::chrono::microseconds(100));
  turns.sort(4);
  EXPECT_EQ(turns.at(3), 1);
  for (const int count : {2, 6}) {
    turns.sort(count);
    for (int turn = 0; turn < count; ++turn) EXPECT_EQ(turns.at(turn), turn) << count;
  }
}

TEST(Turns, WorkersFollowThem) {
  Workers workers(2);
  Turns turns;
  for (int round = 0; round < 50; ++round) {
    turns.sort(6);
    turns.took(round % 6, std::chrono::hours(1));
    std::vector<int> began;
    std::mutex one_at_a_time;
    workers.run(6, turns, [&](int task) {
      const std::lock_guard lock(one_at_a_time);
      began.push_back(task);
    });
    ASSERT_EQ(std::set<int>(began.begin(), began.end()).size(), 6U);
    // Another thread may have taken its task later and recorded it sooner.
    EXPECT_TRUE(began[0] == round % 6 || began[1] == round % 6) << began[0] << ", " << began[1];
  }
}

TEST(Workers, ManyTasksAndNone) {
  Workers workers(2);
  std::vector<unsigned char> done(100'000);
  workers.run(static_cast<int>(done.size()), [&](int i) { ++done[static_cast<std::size_t>(i)]; });
  EXPECT_EQ(std::set<unsigned char>(done.begin(), done.end()), std::set<unsigned char>{1});
  workers.run(0, [](int) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace voxmelt::cpu
