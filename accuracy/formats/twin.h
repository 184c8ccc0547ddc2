// The twin is a second, plain program of the paper's law, in a number format of one's choice. It tells the
// cost of the format and its rounding from the cost of the model. In 16 bits with dither it gives the
// engine's bits.
//
// Its random choices are those of the automaton. Fractions, the table of mobility and the irradiance are the
// scene's integers in every format. A format changes the state, and what the rules round.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/formats/format.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy::front {

// Holds the contents of one cell, in cells and in parts of the range of heat.
struct Held {
  bool solid = false;
  double amount = 0, energy = 0, heat = 0;
};
using VisitHeld = std::function<void(int x, int y, int z, const Held& held)>;

class Twin {
 public:
  virtual ~Twin() = default;
  virtual void step() = 0;
  virtual void for_each_matter(const VisitHeld& visit) const = 0;
  virtual state::Volume volume() const = 0;  // rounded to the nearest unit of the 16-bit state
};

enum class Number { u8, u16, u32, f32, f64 };

// Names a number format and how it rounds. A real one has no rounding to choose: `truncate` stands for none.
struct Arithmetic {
  Number number = Number::u16;
  Rounding rounding = Rounding::dithered;
  friend bool operator==(const Arithmetic&, const Arithmetic&) = default;
};
inline constexpr Arithmetic kEngine{Number::u16, Rounding::dithered};
inline constexpr Arithmetic kExact{Number::f64, Rounding::truncate};

bool is_real(Number number);
std::string name_of(Arithmetic arithmetic);  // "u16 dithered", "double"
const std::vector<Arithmetic>& all_arithmetics();

// Returns the bits of state per cell that a scene needs: two masks, amount, energy, and heat if the scene has
// heat.
int state_bits(Number number, const rule::Parameters& parameters);

// Throws std::invalid_argument for the viscous law and for the reading `printed`, as the twin knows neither.
std::unique_ptr<Twin> make_twin(Arithmetic arithmetic, const rule::Parameters& parameters,
                                const state::Volume& start, std::uint32_t first_step = 0);

}  // namespace voxmelt::accuracy::front
