// The parts of the forecast (forecast.h): queues of tokens that carry nothing but the number of a ray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/pass_counts.h"

namespace voxmelt::hwmodel::raycast::forecasts {

using Time = std::int64_t;

// A channel: what enters in a cycle can leave in the next one, and so can what takes its place.
template <class Token>
class Line {
 public:
  explicit Line(int depth) : depth_(static_cast<std::size_t>(depth)) {}
  bool ready(Time now) const { return tokens_.size() + (left_ == now ? 1 : 0) < depth_; }
  bool valid(Time now) const { return !tokens_.empty() && tokens_.front().first < now; }
  const Token& front() const { return tokens_.front().second; }
  void put(Time now, const Token& token) { tokens_.emplace_back(now, token); }
  Token get(Time now) {
    const Token token = tokens_.front().second;
    tokens_.pop_front();
    left_ = now;
    return token;
  }

 private:
  std::size_t depth_;
  std::deque<std::pair<Time, Token>> tokens_;
  Time left_ = -1;
};

// A request for words: of which ray, and what was counted of it.
struct Request {
  std::int32_t ray = 0;
  const RayEvent* counted = nullptr;
};
// A line on its way from memory, or a burst on its way there.
struct Transfer {
  int client = 0;
  std::int64_t request = 0;
  int bytes = 0;
  bool write = false;
};

// A cache with its queue: a miss is asked for in a cycle, and words leave in the order of their requests.
class Fetch {
 public:
  Fetch(int client, int queue, int free, int line_bytes, int fifo_depth, int wide_cycles)
      : to_memory(fifo_depth),
        client_(client),
        line_bytes_(line_bytes),
        wide_cycles_(wide_cycles),
        queue_(static_cast<std::size_t>(queue)),
        free_(free) {}

  void arrived(std::int64_t request) { --entries_[static_cast<std::size_t>(request - first_)].missing; }
  void look_up(Time now, Line<Request>& in) {
    if (!in.valid(now)) return;
    if (!open_) {
      if (entries_.size() == queue_) return;
      entries_.push_back({in.front(), 0});
      open_ = true;
      asked_ = 0;
    }
    const int misses = in.front().counted->misses;
    if (misses > 0) {
      if (free_ == 0 || !to_memory.ready(now)) return;
      --free_, ++asked_;
      ++entries_.back().missing;
      to_memory.put(now,
                    {client_, first_ + static_cast<std::int64_t>(entries_.size()) - 1, line_bytes_, false});
      if (asked_ < misses) return;
    }
    in.get(now);
    open_ = false;
  }
  // `out(request)` is the channel of its answer.
  template <class Out>
  void read(Time now, const Out& out) {
    if (entries_.size() == (open_ ? 1u : 0u) || entries_.front().missing > 0) return;
    const Request& request = entries_.front().request;
    Line<Request>& to = out(request);
    if (!to.ready(now)) return;
    if (++reading_ < (request.counted->kind == Asked::normal ? wide_cycles_ : 1)) return;
    reading_ = 0;
    to.put(now, request);
    free_ += request.counted->lost;
    entries_.pop_front();
    ++first_;
  }

  Line<Transfer> to_memory;

 private:
  struct Entry {
    Request request;
    int missing = 0;
  };
  int client_, line_bytes_, wide_cycles_;
  std::size_t queue_;
  int free_;
  std::deque<Entry> entries_;
  std::int64_t first_ = 0;  // the number of the first entry
  bool open_ = false;       // the last entry is being looked up
  int asked_ = 0, reading_ = 0;
};

// The memory and its bus, for all pipes.
class SharedMemory {
 public:
  SharedMemory(int latency, int bus_bytes, int pipes, int fifo_depth)
      : latency_(latency), bus_bytes_(bus_bytes) {
    for (int i = 0; i < pipes; ++i) requests.emplace_back(fifo_depth), replies.emplace_back(fifo_depth);
  }
  void cycle(Time now) {
    if (!under_way_.empty() && under_way_.front().done <= now &&
        replies[under_way_.front().pipe].ready(now)) {
      replies[under_way_.front().pipe].put(now, under_way_.front().transfer);
      under_way_.pop_front();
    }
    if (under_way_.size() >= kMostUnderWay) return;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const std::size_t pipe = (turn_ + i) % requests.size();
      if (!requests[pipe].valid(now)) continue;
      turn_ = (pipe + 1) % requests.size();
      const Transfer transfer = requests[pipe].get(now);
      const std::int64_t beats = (transfer.bytes + bus_bytes_ - 1) / bus_bytes_;
      const Time begin = now + (transfer.write ? 1 : latency_);
      bus_free_ = (bus_free_ > begin ? bus_free_ : begin) + beats;
      if (transfer.write)
        written += transfer.bytes;
      else
        under_way_.push_back({bus_free_, pipe, transfer});
      return;
    }
  }

  std::deque<Line<Transfer>> requests, replies;  // of each pipe
  std::int64_t written = 0;

 private:
  static constexpr std::size_t kMostUnderWay = 256;
  struct UnderWay {
    Time done;
    std::size_t pipe;
    Transfer transfer;
  };
  int latency_, bus_bytes_;
  Time bus_free_ = 0;
  std::size_t turn_ = 0;
  std::deque<UnderWay> under_way_;
};

// A ray's events, in their order.
class Course {
 public:
  explicit Course(const std::vector<RayEvent>& events) : events_(&events) {}
  const RayEvent& next() const { return (*events_)[at_]; }
  bool is(Asked kind) const { return at_ < events_->size() && next().kind == kind; }
  const RayEvent* take() { return &(*events_)[at_++]; }
  int count(Asked kind) const {
    std::size_t end = at_;
    while (end < events_->size() && (*events_)[end].kind == kind) ++end;
    return static_cast<int>(end - at_);
  }

 private:
  const std::vector<RayEvent>* events_;
  std::size_t at_ = 0;
};

// A stage that fetches something for each surface, and hands all on in their order.
class Attach {
 public:
  Attach(Asked kind, std::size_t most) : kind_(kind), most_(most) {}
  void cycle(Time now, std::vector<Course>& rays, Line<std::int32_t>& in, Line<Request>& ask,
             Line<Request>& answer, Line<std::int32_t>& out) {
    if (!waiting_.empty() && waiting_.front().answered == waiting_.front().questions && out.ready(now)) {
      out.put(now, waiting_.front().ray);
      waiting_.pop_front();
      if (unasked_ > 0) --unasked_;
      if (unanswered_ > 0) --unanswered_;
    }
    if (answer.valid(now)) {
      answer.get(now);
      while (waiting_[unanswered_].answered == waiting_[unanswered_].questions) ++unanswered_;
      ++waiting_[unanswered_].answered;
    }
    while (unasked_ < waiting_.size() && waiting_[unasked_].asked == waiting_[unasked_].questions) ++unasked_;
    if (unasked_ < waiting_.size() && ask.ready(now)) {
      Waiting& of = waiting_[unasked_];
      ask.put(now, {of.ray, rays[static_cast<std::size_t>(of.ray)].take()});
      ++of.asked;
    }
    if (in.valid(now) && waiting_.size() < most_) {
      const std::int32_t ray = in.get(now);
      waiting_.push_back({ray, rays[static_cast<std::size_t>(ray)].count(kind_), 0, 0});
    }
  }

 private:
  struct Waiting {
    std::int32_t ray;
    int questions, asked, answered;
  };
  Asked kind_;
  std::size_t most_;
  std::deque<Waiting> waiting_;
  std::size_t unasked_ = 0, unanswered_ = 0;
};

}  // namespace voxmelt::hwmodel::raycast::forecasts
