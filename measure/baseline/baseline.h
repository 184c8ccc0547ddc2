// The baseline is the paper's algorithm as a competent graphics programmer writes it without special effort:
// real fields, a byte per flag, whole-grid loops, one thread. It is frozen, because every speed ratio of this
// project is to it.
//
// It runs the paper's law (docs/automaton.md, sections 6 to 9) in real numbers: 1 is a full cell, and the top
// of the range of temperatures. The bounds that only integers need are left out, and so are vents, drains and
// open borders.
#pragma once

#include <cstdint>
#include <span>

#include "measure/baseline/fields.h"
#include "measure/baseline/numbers.h"

namespace voxmelt::baseline {

// The plain variant is built by g++ -O2. The native one has -O3 -march=native, and skips rows along x without
// anything near them. The variant is a part of every phase's symbol, so the linker cannot take the code of
// the one for the other.
enum class Variant { plain, native };

template <class Real, Variant variant = Variant::plain>
class Baseline {
 public:
  // Throws std::invalid_argument for parameters that it does not run (see numbers.h).
  Baseline(const state::Volume& volume, const rule::Parameters& parameters)
      : fields_(volume), numbers_(numbers_of<Real>(parameters)) {}

  // A step runs these phases in this order. `irradiance` comes from irradiance_of, and is empty without
  // radiation.
  void heat(std::span<const Real> irradiance = {});  // and melting
  void gravity();
  void spread(std::uint32_t step);
  void excess();

  void update();  // the picture: intensities 0..255 and their low-pass filter

  Fields<Real>& fields() { return fields_; }
  const Fields<Real>& fields() const { return fields_; }

 private:
  void conduct(std::span<const Real> irradiance);
  void melt();
  void find_patterns(std::uint32_t step);
  void give();
  void receive();

  static constexpr bool kSkipsRows = variant == Variant::native;

  Fields<Real> fields_;
  Numbers<Real> numbers_;
};

}  // namespace voxmelt::baseline
