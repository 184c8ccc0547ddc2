// Tools that look at any machine see it as a number of channels, each with tokens of its own type, in cycles.
// A SystemC model is such a source, and so is a recorded trace. A simulation of RTL could be a third.
//
// In every cycle a probe hears of every channel: which side was ready, what entered, what could be taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel {

struct TokenWire {
  std::string name;
  int bits = 1;  // at most 64
  bool has_sign = false;
};

// Describes the tokens of a channel. Each lane has the same wires.
struct TokenType {
  int lanes = 1;
  std::vector<TokenWire> wires;
  // Writes the values of a token: those of lane 0 in the order of the wires, then of lane 1, ...
  std::function<void(const void* token, std::int64_t* values)> read;

  std::size_t values() const { return lanes * wires.size(); }
};

struct TokenChannel {
  std::string name;  // "step 0: gravity -> pattern"
  int number = 0;    // the number that a probe hears
  int depth = 0;     // tokens; 0: not known
  TokenType type;
};

// Names the classes of a stage's cycles. A cycle is of one class, or of none.
struct StageClasses {
  std::string name;
  std::vector<std::string> classes;
};

class TokenSource {
 public:
  virtual ~TokenSource() = default;

  virtual std::vector<TokenChannel> token_channels() const = 0;
  // Sets the probe of all channels, or removes it if `probe` is null.
  virtual void probe(ChannelProbe* probe) = 0;
  virtual std::int64_t cycle() const = 0;  // the present cycle
  virtual void stop() = 0;                 // ends the run after the present cycle

  // Returns the stages, and how many cycles of each class they had so far: stage by stage, in the order of
  // classes.
  virtual std::vector<StageClasses> stage_classes() const { return {}; }
  virtual std::vector<std::int64_t> stage_counts() const { return {}; }
};

}  // namespace voxmelt::hwmodel
