// Threads work off items, beside the thread that brings them.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace voxmelt::render {

// Begins work in the order in which items were put. At most `room` of them wait. So a slow line holds up the
// caller of put(), and memory does not grow. Once an item's work has thrown, items that wait are dropped.
template <class Item>
class WorkLine {
 public:
  using Work = std::function<void(Item&)>;

  // Starts the threads. With no threads, put() does the work itself.
  WorkLine(int threads, std::size_t room, Work work) : room_(room), work_(std::move(work)) {
    for (int t = 0; t < threads; ++t) threads_.emplace_back([this] { work_off(); });
  }
  WorkLine(const WorkLine&) = delete;
  WorkLine& operator=(const WorkLine&) = delete;

  // Drops the items that wait.
  ~WorkLine() {
    {
      const std::lock_guard lock(mutex_);
      waiting_.clear();
      closed_ = true;
    }
    item_came_.notify_all();
  }

  // Throws what work has thrown.
  void put(Item item) {
    if (threads_.empty()) return work_(item);
    std::unique_lock lock(mutex_);
    item_left_.wait(lock, [&] { return waiting_.size() < room_ || failed_; });
    throw_if_failed(lock);
    waiting_.push_back({next_turn_++, std::move(item)});
    item_came_.notify_one();
  }

  // Returns when all work is done. Throws what work has thrown.
  void wait() {
    std::unique_lock lock(mutex_);
    item_left_.wait(lock, [&] { return (waiting_.empty() && busy_ == 0) || failed_; });
    throw_if_failed(lock);
  }

  // Throws what work has thrown, without waiting for any that goes well.
  void check() {
    if (!failed_) return;
    std::unique_lock lock(mutex_);
    throw_if_failed(lock);
  }

 private:
  struct Waiting {
    std::uint64_t turn;
    Item item;
  };

  // Items before the one that failed may still be in work, and fail too. The first of them counts, so that
  // the message does not depend on the threads.
  void throw_if_failed(std::unique_lock<std::mutex>& lock) {
    if (!failed_) return;
    item_left_.wait(lock, [&] { return busy_ == 0; });
    std::rethrow_exception(error_);
  }

  void work_off() {
    std::unique_lock lock(mutex_);
    for (;;) {
      item_came_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      {  // the item's memory is freed before waiters hear that it is done
        Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        ++busy_;
        lock.unlock();
        item_left_.notify_all();
        std::exception_ptr error;
        try {
          work_(next.item);
        } catch (...) {
          error = std::current_exception();
        }
        lock.lock();
        if (error) fail(next.turn, error);
      }
      --busy_;
      item_left_.notify_all();
    }
  }

  void fail(std::uint64_t turn, const std::exception_ptr& error) {
    if (!failed_ || turn < failed_turn_) {
      failed_turn_ = turn;
      error_ = error;
    }
    failed_ = true;
    waiting_.clear();
  }

  const std::size_t room_;
  const Work work_;
  std::mutex mutex_;
  std::condition_variable item_came_, item_left_;
  std::deque<Waiting> waiting_;
  std::uint64_t next_turn_ = 0, failed_turn_ = 0;
  int busy_ = 0;
  bool closed_ = false;
  std::atomic<bool> failed_{false};
  std::exception_ptr error_;
  std::vector<std::jthread> threads_;  // last, as they must end before the rest does
};

}  // namespace voxmelt::render
