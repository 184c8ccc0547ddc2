// Tools that look at any machine find here what each channel of a pipe carries: which wires, and their
// values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "hwmodel/caster/model/pipe.h"
#include "hwmodel/caster/model/token_wires.h"
#include "hwmodel/check/token_source.h"

namespace voxmelt::hwmodel::raycast {

constexpr Behind behind(Channel channel) {
  switch (channel) {
    case Channel::met:
      return Behind::met;
    case Channel::normal:
      return Behind::normal;
    case Channel::paint:
      return Behind::paint;
    case Channel::texture:
      return Behind::texture;
    case Channel::matter:
      return Behind::matter;
    case Channel::light:
      return Behind::light;
    case Channel::arriving:
      return Behind::arriving;
    case Channel::mirror:
      return Behind::mirror;
    default:
      return Behind::colour;
  }
}

// Visits the wires of a fetching stage's requests, and of the words that answer them. cost.h counts their
// bits.
template <class Visit>
void wires_of(const Spots& at, Visit&& visit) {
  visit(WireName{"cell_x"}, 12, false, at.x.cell);
  visit(WireName{"weight_x"}, 8, false, at.x.weight);
  visit(WireName{"cell_y"}, 12, false, at.y.cell);
  visit(WireName{"weight_y"}, 8, false, at.y.weight);
  visit(WireName{"cell_z"}, 12, false, at.z.cell);
  visit(WireName{"weight_z"}, 8, false, at.z.weight);
}
template <class Visit>
void wires_of(const MatterRequest& request, const ContextBits&, Visit&& visit) {
  wires_of(request.at, visit);
}
template <class Visit>
void wires_of(const ClampedRequest& request, const ContextBits&, Visit&& visit) {
  wires_of(request.at, visit);
  visit(WireName{"context"}, 16, true, request.context);
}
template <class Request, class Word, std::size_t kMost, class Visit>
void wires_of(const Gathered<Request, Word, kMost>& answer, const ContextBits& context, Visit&& visit) {
  wires_of(answer.request, context, visit);
  for (std::size_t i = 0; i < kMost; ++i)  // words as they lie in memory, eight bytes at a time
    for (std::size_t from = 0; from < sizeof(Word); from += 8) {
      const std::size_t bytes = std::min<std::size_t>(8, sizeof(Word) - from);
      std::int64_t value = 0;
      std::memcpy(&value, reinterpret_cast<const char*>(&answer.words[i]) + from, bytes);
      visit(WireName("word", from == 0 ? "" : "_more", i), static_cast<int>(8 * bytes), false, value);
    }
}
template <class Visit>
void wires_of(const LineRequest& request, const ContextBits&, Visit&& visit) {
  visit(WireName{"client"}, 3, false, request.client);
  visit(WireName{"slot"}, 16, false, request.slot);
  visit(WireName{"address"}, 32, false, request.address);
  visit(WireName{"bytes"}, 16, false, request.bytes);
  visit(WireName{"write"}, 1, false, request.write ? 1 : 0);
  for (int i = 0; i < kBurst / 8; ++i) {
    std::int64_t word = 0;
    if (request.write) std::memcpy(&word, request.data.data() + std::ptrdiff_t{8} * i, 8);
    visit(WireName{"data", "", i}, 64, false, word);
  }
}

// Visits the wires of a token in a channel.
template <class Word, class Visit>
void wires_in(Channel channel, const Word& word, const ContextBits& context, Visit&& visit) {
  if constexpr (std::is_same_v<Word, Surface>) {
    wires_of(word, behind(channel), context, visit);
  } else if constexpr (std::is_same_v<Word, HitToken>) {
    if (channel == Channel::exits)
      wires_of_exit(word, context, visit);
    else
      wires_of(word, context, visit);
  } else {
    wires_of(word, context, visit);
  }
}

template <class Word>
TokenType type_of(Channel channel, const ContextBits& context) {
  Word any{};
  if constexpr (std::is_same_v<Word, Levels>)
    if (channel == Channel::normal_levels) any.request.asker = Asker::normal;
  TokenType type;
  wires_in(channel, any, context, [&](const WireName& name, int bits, bool has_sign, std::int64_t) {
    type.wires.push_back({name.text(), bits, has_sign});
  });
  type.read = [channel, context, count = type.wires.size()](const void* token, std::int64_t* values) {
    std::size_t i = 0;  // a token on the wrong way may have other wires
    wires_in(channel, *static_cast<const Word*>(token), context,
             [&](const WireName&, int, bool, std::int64_t value) {
               if (i < count) values[i++] = value;
             });
    while (i < count) values[i++] = 0;
  };
  return type;
}

// Tells a channel's cycles by a number of its own, because a pipe's channels to its memory port have the same
// one.
class NumberedProbe final : public ChannelProbe {
 public:
  explicit NumberedProbe(int number) : number_(number) {}
  void tell(ChannelProbe* to) { to_ = to; }
  void cycle(int /*channel*/, const Sides& sides, const void* in, const void* out) override {
    to_->cycle(number_, sides, in, out);
  }

 private:
  int number_;
  ChannelProbe* to_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
