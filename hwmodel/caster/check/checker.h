// The checker compares every token that leaves a stage of the ray caster with the reference. The first
// difference ends the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hwmodel/caster/check/difference.h"
#include "hwmodel/caster/check/expectation.h"
#include "hwmodel/caster/check/memory_check.h"
#include "hwmodel/caster/check/tile_check.h"
#include "hwmodel/caster/check/transit.h"
#include "hwmodel/caster/model/ray_caster.h"

namespace voxmelt::hwmodel::raycast {

class Checker final : FifoWatcher<TileOrder>,
                      FifoWatcher<RayToken>,
                      FifoWatcher<GroundedRay>,
                      FifoWatcher<LevelRequest>,
                      FifoWatcher<Levels>,
                      FifoWatcher<LevelToken>,
                      FifoWatcher<HitToken>,
                      FifoWatcher<MetToken>,
                      FifoWatcher<Surface>,
                      FifoWatcher<PressedToken>,
                      FifoWatcher<PixelToken>,
                      FifoWatcher<LineRequest>,
                      FifoWatcher<PassedToken>,
                      LeapWatcher {
 public:
  Checker(const Expectation& expectation, const Registers& registers, RayCaster& caster, int width,
          int height);

  Watchers watchers();
  // The first pass has one sample of each pixel. The second one has several, of the pixels that differ from a
  // neighbour by more than `most`. `frame` is the address at which the pass is written.
  void begin_pass(int samples, int most, std::int64_t frame, const Window& window = {});
  // Lets the run go on after a difference, for waves. Whoever wants them ends the run.
  void run_on_at_difference() { stops_ = false; }
  // Looks for what never came, after the pass.
  void end_pass(const FrameEnd& end);
  const std::optional<Difference>& difference() const { return difference_; }
  std::int64_t compared() const { return compared_; }  // numbers that were compared
  // Returns the first ray in the picture that has not come to its end. In a complete pass all rays have.
  std::optional<RayId> ray_under_way() const;

 private:
  void entered(int channel, std::int64_t ordinal, const TileOrder* token) override;
  void entered(int channel, std::int64_t ordinal, const RayToken* token) override;
  void entered(int channel, std::int64_t ordinal, const GroundedRay* token) override;
  void entered(int channel, std::int64_t ordinal, const LevelRequest* token) override;
  void entered(int channel, std::int64_t ordinal, const Levels* token) override;
  void entered(int channel, std::int64_t ordinal, const LevelToken* token) override;
  void entered(int channel, std::int64_t ordinal, const HitToken* token) override;
  void entered(int channel, std::int64_t ordinal, const MetToken* token) override;
  void entered(int channel, std::int64_t ordinal, const Surface* token) override;
  void entered(int channel, std::int64_t ordinal, const PressedToken* token) override;
  void entered(int channel, std::int64_t ordinal, const PixelToken* token) override;
  void entered(int channel, std::int64_t ordinal, const LineRequest* token) override;
  void entered(int channel, std::int64_t ordinal, const PassedToken* token) override;
  void left(int, std::int64_t, const TileOrder*) override {}
  void left(int, std::int64_t, const RayToken*) override {}
  void left(int, std::int64_t, const GroundedRay*) override {}
  void left(int, std::int64_t, const LevelRequest*) override {}
  void left(int, std::int64_t, const Levels*) override {}
  void left(int, std::int64_t, const LevelToken*) override {}
  void left(int, std::int64_t, const HitToken*) override {}
  void left(int, std::int64_t, const MetToken*) override {}
  void left(int, std::int64_t, const Surface*) override {}
  void left(int, std::int64_t, const PressedToken*) override {}
  void left(int, std::int64_t, const PixelToken* token) override {
    tile_check_.pixel_complete(token->id.x, token->id.y);
  }
  void left(int, std::int64_t, const LineRequest*) override {}
  void left(int, std::int64_t, const PassedToken*) override {}

  // A leap may leave out only samples of which it is proved that they are air (leap_check.h).
  void leapt(const LeapTaken& leap) override;

  void tell(Difference difference);
  ExpectedRay& ray(const RayId& id);
  ExpectedRay& shaded(const RayId& id);
  std::size_t index_of(const RayId& id) const;
  std::size_t byte_of(int x, int y) const;  // offset in a frame
  bool drawn_again(int x, int y) const;
  template <class Value>
  void compare(const char* stage, const RayId& id, const char* name, const Value& expected,
               const Value& actual, const Vec* position = nullptr);
  class SurfacePair;
  void compare_surface(Channel behind, const Surface& expected, const Surface& actual,
                       const ExpectedRay& ray);
  // These compare rays through clear matter (checker_clear.cpp).
  void compare_clear(const HitToken& token);
  void compare_clear(const MetToken& token);
  void compare_clear(Channel behind, const Surface& token);
  void compare_crossing(const RayId& id, const picture::Crossing& expected, const Crossing& actual);

  const Expectation& expectation_;
  const Registers& registers_;
  RayCaster& caster_;
  std::size_t width_;
  int height_, samples_ = 1;
  std::vector<std::int32_t> places_;  // indices into `rays_`, by pixel and sample; -1 if not there
  std::vector<ExpectedRay> rays_;
  std::vector<std::int32_t> free_;
  std::vector<Rgb> sums_;                    // pressed light, by pixel
  std::vector<std::uint8_t> bytes_, first_;  // expected, tile by tile; those of the first pass
  int most_ = 0, tiles_x_ = 0;
  std::int64_t frame_ = 0;
  Window window_;
  std::optional<std::int64_t> ended_;  // cycles of the pass, if it has ended
  Transit transit_;
  TileCheck tile_check_;
  MemoryCheck memory_check_;
  bool stops_ = true;  // ends the run at a difference
  std::optional<Difference> difference_;
  std::int64_t compared_ = 0;
};

}  // namespace voxmelt::hwmodel::raycast
