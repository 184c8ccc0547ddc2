#include "hwmodel/caster/check/transit.h"

#include <fmt/format.h>

namespace voxmelt::hwmodel::raycast {
namespace {

std::string text_of(const RayId& id) {
  return fmt::format("the token of pixel ({}, {}), sample {}", id.x, id.y, id.sample);
}

}  // namespace

Transit::Transit(const RayCaster& caster, Tell tell) : caster_(caster), tell_(std::move(tell)) {}

Watchers Transit::around(Watchers w) {
  w.tiles = around(w.tiles), w.set_up = around(w.set_up), w.ground = around(w.ground),
  w.asks = around(w.asks);
  w.levels = around(w.levels), w.samples = around(w.samples), w.hits = around(w.hits), w.met = around(w.met);
  w.surfaces = around(w.surfaces), w.pressed = around(w.pressed), w.pixels = around(w.pixels);
  w.passed = around(w.passed);
  return w;
}

Transit::Line& Transit::line(int channel) {
  const auto i = static_cast<std::size_t>(channel);
  if (i >= under_way_.size()) under_way_.resize(i + 1);
  return under_way_[i];
}

void Transit::left(int channel, const Token& token) {
  Line& of = line(channel);
  ++compared_;
  const auto same = [](const Token& a, const Token& b) { return same_place(a.id, b.id) && a.sum == b.sum; };
  if (of.tokens.empty() || !same(of.tokens.front(), token)) {
    const std::string expected = of.tokens.empty() ? "none" : text_of(of.tokens.front().id);
    if (of.any_left && same(of.last, token))
      tell(channel, token.id, "leaves twice", expected, text_of(token.id));
    else if (of.tokens.empty() || same_place(of.tokens.front().id, token.id))
      tell(channel, token.id, "leaves as it entered", expected, text_of(token.id) + ", changed");
    else
      tell(channel, of.tokens.front().id, "leaves next", expected, text_of(token.id));
  }
  if (!of.tokens.empty()) of.tokens.pop_front();
  of.last = token;
  of.any_left = true;
}

void Transit::look_for_lost() {
  for (int i = 0; i < caster_.pipes(); ++i)
    for (const Pipe::ChannelState& channel : caster_.pipe(i).channels()) {
      const Line& of = line(channel.number);
      if (static_cast<int>(of.tokens.size()) <= channel.count) continue;
      const RayId& id = of.tokens[static_cast<std::size_t>(channel.count)].id;
      return tell(channel.number, id, "leaves", text_of(id), "nothing");
    }
}

void Transit::tell(int channel, const RayId& at, const char* name, std::string expected, std::string actual) {
  Difference of;
  of.stage = name_of(channel), of.name = name;
  of.x = at.x, of.y = at.y, of.sample = at.sample;
  of.expected = std::move(expected), of.actual = std::move(actual);
  tell_(std::move(of));
}

std::string Transit::name_of(int number) const {
  for (int i = 0; i < caster_.pipes(); ++i)
    for (const Pipe::ChannelState& channel : caster_.pipe(i).channels())
      if (channel.number == number) return channel.name;
  return "channel " + std::to_string(number);
}

}  // namespace voxmelt::hwmodel::raycast
