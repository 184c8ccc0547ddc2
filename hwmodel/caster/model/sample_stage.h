// The sampler makes one level of eight, a sample a cycle.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

template <class Faults = NoFaults>
class SampleStage final : public Stage {
 public:
  explicit SampleStage(Faults faults = {}) : Stage("sample"), faults_(faults) {}
  void connect(Fifo<Levels>& in, Fifo<LevelToken>& to_walk, Fifo<LevelToken>& to_crossing) {
    in_ = &in;
    to_walk_ = &to_walk;
    to_crossing_ = &to_crossing;
  }
  void connect_stretch(Fifo<LevelToken>& to_stretch) { to_stretch_ = &to_stretch; }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    const Levels& levels = *in_->oldest();
    Fifo<LevelToken>& out = levels.request.asker == Asker::walk      ? *to_walk_
                            : levels.request.asker == Asker::stretch ? *to_stretch_
                                                                     : *to_crossing_;
    if (!out.ready()) return Did::blocked;
    in_->get();
    SInt<16> level = sample_of(levels.words.data(), levels.request.at);
    faults_.sampled(levels, level);
    *out.put() = {levels.request, static_cast<std::int16_t>(level)};
    return Did::busy;
  }

  [[no_unique_address]] Faults faults_;
  Fifo<Levels>* in_ = nullptr;
  Fifo<LevelToken>* to_walk_ = nullptr;
  Fifo<LevelToken>* to_crossing_ = nullptr;
  Fifo<LevelToken>* to_stretch_ = nullptr;
};

// Joins several that ask the same memory, on one channel. The first of them comes first.
template <class Request>
class AskStage final : public Stage {
 public:
  explicit AskStage(std::string name) : Stage(std::move(name)) {}
  void connect(std::vector<Fifo<Request>*> in, Fifo<Request>& out) {
    in_ = std::move(in);
    out_ = &out;
  }

 private:
  Did cycle() override {
    for (Fifo<Request>* in : in_) {
      if (!in->valid()) continue;
      if (!out_->ready()) return Did::blocked;
      *out_->put() = *in->get();
      return Did::busy;
    }
    return Did::starved;
  }

  std::vector<Fifo<Request>*> in_;
  Fifo<Request>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
