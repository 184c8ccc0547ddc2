// An attach stage fetches something for each surface that needs it, and hands all on in their order. Several
// surfaces wait for their answers at once.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>

#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

template <class Request, class Answer>
class AttachStage : public Stage {
 public:
  AttachStage(std::string name, std::size_t most) : Stage(std::move(name)), most_(most) {}
  void connect(Fifo<Surface>& in, Fifo<Request>& ask, Fifo<Answer>& answer, Fifo<Surface>& out) {
    in_ = &in;
    ask_ = &ask;
    answer_ = &answer;
    out_ = &out;
  }

 protected:
  virtual int questions(const Surface& surface) const = 0;
  virtual Request question(const Surface& surface, int which) const = 0;
  virtual void take(Surface& surface, int which, const Answer& answer) = 0;
  virtual void finish(Surface& /*surface*/) {}  // called when all answers are there

 private:
  struct Waiting {
    Surface surface;
    int questions = 0, asked = 0, answered = 0;
  };

  Did cycle() override {
    bool moved = false, blocked = false;
    if (!waiting_.empty() && waiting_.front().answered == waiting_.front().questions) {
      if (out_->ready()) {
        finish(waiting_.front().surface);
        *out_->put() = waiting_.front().surface;
        waiting_.pop_front();
        if (first_unasked_ > 0) --first_unasked_;
        if (first_unanswered_ > 0) --first_unanswered_;
        moved = true;
      } else {
        blocked = true;
      }
    }
    // Answers come in the order of the questions.
    if (answer_->valid()) {
      while (waiting_[first_unanswered_].answered == waiting_[first_unanswered_].questions)
        ++first_unanswered_;
      Waiting& waiting = waiting_[first_unanswered_];
      take(waiting.surface, waiting.answered++, *answer_->get());
      moved = true;
    }
    while (first_unasked_ < waiting_.size() &&
           waiting_[first_unasked_].asked == waiting_[first_unasked_].questions)
      ++first_unasked_;
    if (first_unasked_ < waiting_.size()) {
      Waiting& waiting = waiting_[first_unasked_];
      if (ask_->ready()) {
        Request& request = *ask_->put();
        request = question(waiting.surface, waiting.asked++);
        request.id = waiting.surface.id;
        moved = true;
      } else {
        blocked = true;
      }
    }
    if (in_->valid() && waiting_.size() < most_) {
      const Surface& surface = *in_->get();
      waiting_.push_back({surface, questions(surface), 0, 0});
      moved = true;
    }
    if (moved) return Did::busy;
    if (blocked) return Did::blocked;
    return waiting_.empty() ? Did::starved : Did::memory;
  }

  std::size_t most_;
  std::deque<Waiting> waiting_;
  std::size_t first_unasked_ = 0, first_unanswered_ = 0;
  Fifo<Surface>* in_ = nullptr;
  Fifo<Request>* ask_ = nullptr;
  Fifo<Answer>* answer_ = nullptr;
  Fifo<Surface>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
