#include "hwmodel/caster/check/transit.h"

#include <fmt/format.h>

#include <iterator>

namespace voxmelt::hwmodel::raycast {
namespace {

std::string text_of(const RayId& id) {
  return fmt::format("the token of pixel ({}, {}), sample {}", id.x, id.y, id.sample);
}

}  // namespace

Transit::Transit(const RayCaster& caster, Tell tell) : caster_(caster), tell_(std::move(tell)) {}

Watchers Transit::around(Watchers w) {
  w.tiles = around(w.tiles);
  w.set_up = around(w.set_up);
  w.ground = around(w.ground);
  w.asks = around(w.asks);
  w.levels = around(w.levels);
  w.samples = around(w.samples);
  w.hits = around(w.hits);
  w.met = around(w.met);
  w.surfaces = around(w.surfaces);
  w.pressed = around(w.pressed);
  w.pixels = around(w.pixels);
  w.passed = around(w.passed);
  return w;
}

Transit::Line& Transit::line(int channel) {
  const std::size_t i = channel;
  if (i >= under_way_.size()) under_way_.resize(i + 1);
  return under_way_[i];
}

void Transit::left(int channel, const Token& token) {
  Line& the_line = line(channel);
  ++compared_;
  const auto same = [](const Token& a, const Token& b) { return same_place(a.id, b.id) && a.sum == b.sum; };
  if (the_line.tokens.empty() || !same(the_line.tokens.front(), token)) {
    const std::string expected = the_line.tokens.empty() ? "none" : text_of(the_line.tokens.front().id);
    if (the_line.any_left && same(the_line.last, token))
      tell(channel, token.id, "leaves twice", expected, text_of(token.id));
    else if (the_line.tokens.empty() || same_place(the_line.tokens.front().id, token.id))
      tell(channel, token.id, "leaves as it entered", expected, text_of(token.id) + ", changed");
    else
      tell(channel, the_line.tokens.front().id, "leaves next", expected, text_of(token.id));
  }
  if (!the_line.tokens.empty()) the_line.tokens.pop_front();
  the_line.last = token;
  the_line.any_left = true;
}

void Transit::look_for_lost() {
  for (int i = 0; i < caster_.pipes(); ++i)
    for (const Pipe::ChannelState& channel : caster_.pipe(i).channels()) {
      const Line& the_line = line(channel.number);
      if (std::ssize(the_line.tokens) <= channel.count) continue;
      const RayId& id = the_line.tokens[channel.count].id;
      return tell(channel.number, id, "leaves", text_of(id), "nothing");
    }
}

void Transit::tell(int channel, const RayId& at, const char* name, std::string expected, std::string actual) {
  Difference difference;
  difference.stage = name_of(channel);
  difference.name = name;
  difference.x = at.x;
  difference.y = at.y;
  difference.sample = at.sample;
  difference.expected = std::move(expected);
  difference.actual = std::move(actual);
  tell_(std::move(difference));
}

std::string Transit::name_of(int number) const {
  for (int i = 0; i < caster_.pipes(); ++i)
    for (const Pipe::ChannelState& channel : caster_.pipe(i).channels())
      if (channel.number == number) return channel.name;
  return "channel " + std::to_string(number);
}

}  // namespace voxmelt::hwmodel::raycast
