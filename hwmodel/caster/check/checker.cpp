#include "hwmodel/caster/check/checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <utility>

#include "hwmodel/caster/check/compare.h"
#include "hwmodel/caster/host/keep.h"
#include "render/packet/tables.h"
#include "render/rule/antialias.h"

namespace voxmelt::hwmodel::raycast {
std::string text_of(const Difference& d) {
  const std::string place = d.address < 0 ? fmt::format("pixel ({}, {}), sample {}", d.x, d.y, d.sample)
                                          : fmt::format("the line at address {}", d.address);
  std::string text = fmt::format("DIFFERENCE behind stage {}: {}, cycle {}\n  {}: expected {}, actual {}\n",
                                 d.stage, place, d.cycle, d.name, d.expected, d.actual);
  if (d.has_position) {
    const Vec q = to_lattice(d.position) >> (kCellBits + kBrickBits);
    text += fmt::format("  position {} {} {}, brick ({}, {}, {})\n", d.position.x, d.position.y, d.position.z,
                        q.x, q.y, q.z);
  }
  return text;
}

Checker::Checker(const Expectation& expectation, const Registers& registers, RayCaster& caster, int width,
                 int height)
    : expectation_(expectation),
      registers_(registers),
      caster_(caster),
      width_(width),
      height_(height),
      transit_(caster, [this](Difference difference) { tell(std::move(difference)); }),
      tile_check_(width, height, [this](Difference difference) { tell(std::move(difference)); }),
      memory_check_([this](Difference difference) { tell(std::move(difference)); }) {
  bytes_.resize(frame_bytes(width, height));
  tiles_x_ = (width + kTileSide - 1) / kTileSide;
}

Watchers Checker::watchers() {
  Watchers watchers = transit_.around({this, this, this, this, this, this, this, this, this, this, this, this,
                                       &tile_check_, &memory_check_, &memory_check_, this});
  watchers.leaps = this;
  return watchers;
}

void Checker::begin_pass(int samples, int most, std::int64_t frame, const Window& window) {
  samples_ = samples;
  most_ = most;
  frame_ = frame;
  window_ = window;
  ended_.reset();
  transit_.begin_pass();
  tile_check_.begin_pass(window);
  memory_check_.begin_pass();
  if (samples == 1)
    std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0});
  else
    first_ = bytes_;
  const std::size_t pixels = width_ * height_;
  places_.assign(pixels * samples, -1);
  sums_.assign(pixels, {});
  rays_.clear();
  free_.clear();
}

void Checker::end_pass(const FrameEnd& end) {
  if (difference_ || !(end.complete || end.hangs)) return;
  ended_ = end.cycles;
  tile_check_.end_pass(end.hangs);
  if (end.hangs) transit_.look_for_lost();
}

std::optional<RayId> Checker::ray_under_way() const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i] < 0) continue;
    const std::size_t pixel = i / samples_;
    return RayId{static_cast<std::int32_t>(pixel % width_), static_cast<std::int32_t>(pixel / width_),
                 static_cast<std::int32_t>(i % samples_), 0};
  }
  return {};
}

// A line that arrives is read in the same cycle, and a channel behind it may be looked at first. So a
// difference of the memory comes before all others of its cycle.
void Checker::tell(Difference difference) {
  const bool before = difference.stage == "memory" && !ended_ && difference_ &&
                      difference_->stage != "memory" && difference_->cycle == caster_.cycle();
  if (difference_ && !before) return;
  difference.cycle = ended_.value_or(0);
  if (!ended_) {
    difference.cycle = caster_.cycle();
    if (stops_) caster_.stop();
  }
  difference_ = std::move(difference);
}

std::size_t Checker::index_of(const RayId& id) const { return (id.y * width_ + id.x) * samples_ + id.sample; }

std::size_t Checker::byte_of(int x, int y) const {
  const int tile = y / kTileSide * tiles_x_ + x / kTileSide;
  return tile * kTileBytes + 3 * (y % kTileSide * kTileSide + x % kTileSide);
}

bool Checker::drawn_again(int x, int y) const {
  const int width = static_cast<int>(width_);
  const auto at = [&](int px, int py) {
    const std::uint8_t* bytes = first_.data() + byte_of(px, py);
    return std::array<std::uint8_t, 3>{bytes[0], bytes[1], bytes[2]};
  };
  const auto from = [&](int nx, int ny) {
    return nx >= 0 && ny >= 0 && nx < width && ny < height_ && picture::differ(at(x, y), at(nx, ny), most_);
  };
  return from(x - 1, y) || from(x + 1, y) || from(x, y - 1) || from(x, y + 1);
}

ExpectedRay& Checker::ray(const RayId& id) {
  std::int32_t& place = places_[index_of(id)];
  if (place < 0) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::int32_t>(rays_.size()));
      rays_.emplace_back();
    }
    place = free_.back();
    free_.pop_back();
    const Sub sub = sub_of(samples_, id.sample);
    rays_[place] = expectation_.ray(64 * std::int64_t{id.x} + sub.across, 64 * std::int64_t{id.y} + sub.down);
  }
  return rays_[place];
}
ExpectedRay& Checker::shaded(const RayId& id) {
  ExpectedRay& expected_ray = ray(id);
  if (!expected_ray.shaded) expectation_.shade(expected_ray);
  return expected_ray;
}

void Checker::entered(int, std::int64_t, const TileOrder* token) {
  tile_check_.ordered(*token);
  for (int i = 0; i < kTilePixels; ++i) {
    const int x = token->x + i % kTileSide, y = token->y + i / kTileSide;
    const bool in = x < static_cast<int>(width_) && y < height_ && window_.holds(x, y);
    compare("tiles", {x, y, 0, 0}, "to be drawn", in && (samples_ == 1 || drawn_again(x, y)),
            (token->pixels >> i & 1) != 0);
  }
}

void Checker::entered(int, std::int64_t, const RayToken* token) {
  const ExpectedRay& expected_ray = ray(token->id);
  compare("set-up", token->id, "start", vec_of(expected_ray.ray.start), token->ray.start);
  compare("set-up", token->id, "step", vec_of(expected_ray.ray.step), token->ray.step);
}

void Checker::entered(int, std::int64_t, const GroundedRay* token) {
  const ExpectedRay& expected_ray = ray(token->id);
  const Vec position = vec_of(expected_ray.ground.position);
  compare("ground", token->id, "found", expected_ray.ground.found, token->ground.found);
  if (!expected_ray.ground.found) return;
  compare("ground", token->id, "part", expected_ray.ground.part, token->ground.part, &position);
  compare("ground", token->id, "crossing", position, token->ground.position, &position);
  compare("ground", token->id, "face", static_cast<Face>(expected_ray.ground.face), token->ground.face,
          &position);
}

void Checker::entered(int, std::int64_t, const LevelRequest* token) {
  if (token->asker != Asker::walk && token->asker != Asker::stretch) return;
  const ExpectedRay& expected_ray = ray(token->id);
  const Vec position = from_lattice(token->at);
  compare(token->asker == Asker::walk ? "walk" : "stretch", token->id, "position",
          vec_of(expectation_.at(expected_ray, token->k)), position, &position);
  if (expectation_.clear()) return;
  if (expected_ray.matter.found && token->k > expected_ray.matter.sample)
    compare("walk", token->id, "k, beyond the first sample in matter", expected_ray.matter.sample, token->k,
            &position);
}

void Checker::entered(int, std::int64_t, const Levels* token) {
  const Places places = token->request.places();
  const std::size_t side = places.side;
  const Vec position = from_lattice(token->request.at);
  std::array<std::int16_t, 27> expected{};
  std::array<std::int16_t, 27> actual{};
  std::size_t i = 0;
  for (std::size_t z = 0; z < side; ++z)
    for (std::size_t y = 0; y < side; ++y)
      for (std::size_t x = 0; x < side; ++x, ++i) {
        expected[i] = static_cast<std::int16_t>(expectation_.level(
            places.x[x] - kLatticeBorder, places.y[y] - kLatticeBorder, places.z[z] - kLatticeBorder));
        actual[i] = token->words[i];
      }
  compare("levels", token->request.id, "fetched", expected, actual, &position);
}

void Checker::entered(int, std::int64_t, const LevelToken* token) {
  const Vec position = from_lattice(token->request.at);
  compare("sample", token->request.id, "level", expectation_.sample(vector_of(position)),
          std::int32_t{token->level}, &position);
}

void Checker::entered(int, std::int64_t, const HitToken* token) {
  if (expectation_.clear()) return compare_clear(*token);
  const ExpectedRay& expected_ray = ray(token->ray.id);
  const Vec position = from_lattice(token->at);
  compare("walk", token->ray.id, "the first sample in matter",
          expected_ray.matter.found ? expected_ray.matter.sample : -1, token->k, &position);
}

void Checker::entered(int, std::int64_t, const MetToken* token) {
  if (expectation_.clear()) return compare_clear(*token);
  const ExpectedRay& expected_ray = ray(token->id);
  if (!token->matter.found) {
    const bool hidden = expected_ray.matter.found && expected_ray.ground.found &&
                        expected_ray.matter.sample > (expected_ray.ground.part >> 8) + 1;
    compare("walk", token->id, "matter found", expected_ray.matter.found && !hidden, false);
    return;
  }
  compare_crossing(token->id, expected_ray.matter, token->matter);
}

void Checker::compare_crossing(const RayId& id, const picture::Crossing& expected, const Crossing& actual) {
  const Vec position = vec_of(expected.position);
  compare("crossing", id, "sample", expected.sample, actual.sample, &position);
  compare("crossing", id, "part", std::int64_t{expected.part}, actual.part, &position);
  compare("crossing", id, "crossing", position, actual.position, &position);
}

void Checker::entered(int channel, std::int64_t, const Surface* token) {
  const auto behind = static_cast<Channel>(channel % 100);
  if (expectation_.clear()) return compare_clear(behind, *token);
  const ExpectedRay& ray = shaded(token->id);
  compare_surface(behind, ray.surface, *token, ray);
}

// Compares what one stage, or two, made of a surface.
class Checker::SurfacePair {
 public:
  SurfacePair(Checker& checker, const Surface& expected, const Surface& actual)
      : checker_(checker), e(expected), a(actual) {}

  template <class Value>
  void same(const char* stage, const char* name, const Value& expected, const Value& actual) {
    checker_.compare(stage, a.id, name, expected, actual, &e.position);
  }
  bool matter() const { return e.kind == Surface::Kind::matter; }
  bool ground() const { return e.kind == Surface::Kind::ground; }
  bool way() const { return e.kind == Surface::Kind::way; }

  void met(bool clear) {
    const char* stage = clear ? "stretch" : "met";
    same(stage, "on ground", e.kind, a.kind);
    if (clear) {
      same(stage, "leaves", e.clear.leaves, a.clear.leaves);
      same(stage, "d", e.clear.way, a.clear.way);
    }
    if (!matter() && !ground() && !way()) return;
    same(stage, "position", e.position, a.position);
    if (!clear) same(stage, "depth", e.depth, a.depth);
    same(stage, "to_eye", e.to_eye, a.to_eye);
  }
  void paint(const ExpectedRay& ray) {
    if (!ground()) return;
    same("paint", "normal", vec_of(ray.ground_normal), a.normal);
    if (e.face != Face::top) same("paint", "color", e.color, a.color);  // rock may still come
  }
  void texture() {
    if (ground()) {
      same("texture", "color", e.color, a.color);
      same("texture", "normal", e.normal, a.normal);
    }
  }
  void matter_words() {
    if (!matter() && !way()) return;
    same("matter", "liquid", e.matter.liquid, a.matter.liquid);
    same("matter", "heat", e.matter.heat, a.matter.heat);
    same("matter", "obstacle", e.matter.obstacle, a.matter.obstacle);
  }
  void light() {
    if (!matter() && !ground() && !way()) return;
    same("light", "lamp", e.light.lamp, a.light.lamp);
    same("light", "open", e.light.open, a.light.open);
    same("light", "glow", e.light.glow, a.light.glow);
  }
  void arriving() {
    if (way()) same("arriving", "inner", e.arriving.light, a.arriving.light);
    if (matter() || ground()) {
      same("arriving", "lamp", e.arriving.lamp, a.arriving.lamp);
      same("arriving", "facing", e.arriving.facing, a.arriving.facing);
      same("arriving", "lit", e.arriving.lit, a.arriving.lit);
      same("arriving", "arriving", e.arriving.light, a.arriving.light);
    }
    if (matter() || way()) material();
  }
  void mirror() {
    if (!matter()) return;
    same("mirror", "peak", e.mirrored.peak, a.mirrored.peak);
    same("mirror", "eye", e.mirrored.eye, a.mirrored.eye);
    same("mirror", "more", e.mirrored.more, a.mirrored.more);
    same("mirror", "r", e.mirrored.reflected, a.mirrored.reflected);
    same("mirror", "around", e.mirrored.around, a.mirrored.around);
    same("mirror", "free", e.mirrored.free, a.mirrored.free);
  }
  void colour(bool clear) {
    same("colour", "colour", e.sum, a.sum);
    if (clear && matter()) same("colour", "gleam", e.clear.gleam, a.clear.gleam);
  }

 private:
  void material() {
    same("material", "l", e.mixture.l, a.mixture.l);
    same("material", "w", e.mixture.w, a.mixture.w);
    same("material", "diffuse", e.mixture.material.diffuse, a.mixture.material.diffuse);
    if (way()) return;
    same("material", "mirror", e.mixture.material.mirror, a.mixture.material.mirror);
    same("material", "highlight", e.mixture.material.highlight, a.mixture.material.highlight);
    same("material", "gloss", e.mixture.material.gloss, a.mixture.material.gloss);
    same("material", "emission", e.mixture.emission, a.mixture.emission);
  }

  Checker& checker_;
  const Surface &e, &a;
};

void Checker::compare_surface(Channel behind, const Surface& e, const Surface& a, const ExpectedRay& ray) {
  SurfacePair pair(*this, e, a);
  const bool clear = expectation_.clear();
  switch (behind) {
    case Channel::met:
      return pair.met(clear);
    case Channel::normal:
      if (pair.matter()) pair.same("normal", "normal", e.normal, a.normal);
      return;
    case Channel::paint:
      return pair.paint(ray);
    case Channel::texture:
      return pair.texture();
    case Channel::matter:
      return pair.matter_words();
    case Channel::light:
      return pair.light();
    case Channel::arriving:
      return pair.arriving();
    case Channel::mirror:
      return pair.mirror();
    case Channel::colour:
      return pair.colour(clear);
    default:
      return;
  }
}

void Checker::entered(int, std::int64_t, const PressedToken* token) {
  const ExpectedRay& ray = shaded(token->id);
  compare("press", token->id, "pressed", ray.pressed, token->pressed);
  const std::size_t i = index_of(token->id);
  for (std::size_t c = 0; c < 3; ++c) sums_[i / samples_][c] += ray.pressed[c];
  free_.push_back(places_[i]);  // the ray has come to its end
  places_[i] = -1;
}

void Checker::entered(int, std::int64_t, const PixelToken* token) {
  RayId id = token->id;
  id.sample = 0;
  const Rgb& sum = sums_[index_of(id) / samples_];
  std::array<std::uint8_t, 3> expected{};
  for (std::size_t c = 0; c < 3; ++c) {
    // The sum exceeds full light if a ray came twice. Its channel has told that.
    const std::int32_t light = std::min<std::int32_t>((sum[c] + samples_ / 2) / samples_, picture::kLight);
    expected[c] = render::byte_table()[light];
  }
  compare("pixel", token->id, "bytes", expected, token->bytes);
  std::copy(expected.begin(), expected.end(), bytes_.begin() + byte_of(id.x, id.y));
}

// Beyond the edges of the picture, a tile holds zeros.
void Checker::entered(int, std::int64_t, const LineRequest* token) {
  const std::int64_t from = token->address - frame_;
  if (from < 0 || from + kBurst > std::ssize(bytes_))
    return compare("write", {}, "address in the frame", std::int64_t{0}, from);
  const auto tile = static_cast<int>(from / kTileBytes);
  const RayId first{tile % tiles_x_ * kTileSide, tile / tiles_x_ * kTileSide, 0, 0};
  tile_check_.written(tile, static_cast<int>(from % kTileBytes / kBurst));
  std::array<std::uint8_t, kBurst> expected{};
  std::copy_n(bytes_.begin() + from, kBurst, expected.begin());
  compare("write", first, "bytes of the tile", expected, token->data);
}

}  // namespace voxmelt::hwmodel::raycast
