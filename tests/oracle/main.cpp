// The oracle is an implementation of docs/automaton.md, written from that page alone.
//   oracle DIR [--steps N] [--every K] [--ledger] [--fields DIR2]
#include "state.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

namespace oracle {

// Runs a step of section 3.
void run_step(State& state) {
  const Heat& rules = state.parameters.heat;
  state.offset = dither(state.step);
  state.mixture_offset = state.offset;
  if (state.parameters.pieces.fall) pieces_fall(state);
  if (!state.parameters.paper_law) count_substeps(state);
  if (rules.enabled && rules.radiation && state.step % rules.visibility_every == 0) find_irradiance(state);
  source(state);
  heat(state);
  melt(state);
  if (state.parameters.paper_law) {
    gravity(state);
    spread_paper(state);
  } else {
    for (state.substep = 0; state.substep < state.substeps; ++state.substep) {
      state.mixture_offset = (state.offset + dither(state.substep)) % 65536;
      settle(state);
      spread_viscous(state);
    }
    state.mixture_offset = state.offset;
    gravity(state);
  }
  forget_empty_cells(state);
  ++state.step;
}

namespace {

struct Options {
  std::string folder;
  Int steps = 10;
  Int every = 0;
  bool ledger = false;
  std::string fields;
};

Options read_options(int count, char** words) {
  Options options;
  for (int n = 1; n < count; ++n) {
    const std::string word = words[n];
    const auto value = [&]() -> std::string {
      if (n + 1 >= count) throw std::invalid_argument(word + " wants a value");
      return words[++n];
    };
    if (word == "--steps")
      options.steps = std::stoll(value());
    else if (word == "--every")
      options.every = std::stoll(value());
    else if (word == "--ledger")
      options.ledger = true;
    else if (word == "--fields")
      options.fields = value();
    else if (options.folder.empty() && word.rfind("--", 0) != 0)
      options.folder = word;
    else
      throw std::invalid_argument("unknown option " + word);
  }
  if (options.folder.empty())
    throw std::invalid_argument("usage: oracle DIR [--steps N] [--every K] [--ledger] [--fields DIR2]");
  return options;
}

// Prints the line of section 13. N counts the steps of this run, wherever `step` of the parameters begins.
void print_line(const State& state, Int done) {
  Int solid = 0, liquid = 0;
  for (const Cell& cell : state.cells) {
    solid += cell.solid;
    liquid += cell.liquid;
  }
  std::printf("step %lld digest %016llx mass %lld solid %lld liquid %lld\n", static_cast<long long>(done),
              static_cast<unsigned long long>(digest(state)), static_cast<long long>(mass_held(state)),
              static_cast<long long>(solid), static_cast<long long>(liquid));
  std::fflush(stdout);
}

void warn_of_unknown_irradiance(const State& state) {
  const Heat& rules = state.parameters.heat;
  if (rules.enabled && rules.radiation && state.step % rules.visibility_every != 0)
    std::cerr << "oracle: step " << state.step
              << " is no step of visibility: I is taken as 0 until the next\n";
}

void run(const Options& options) {
  State state = read_state(options.folder);
  warn_of_unknown_irradiance(state);
  if (options.every > 0) print_line(state, 0);
  for (Int done = 1; done <= options.steps; ++done) {
    run_step(state);
    if (options.every > 0 && done % options.every == 0 && done < options.steps) print_line(state, done);
  }
  if (options.every == 0 || options.steps > 0) print_line(state, options.steps);
  check_all(state, "at the end");
  close_ledgers(state);
  if (options.ledger)
    std::cout << ledger_lines(state.ledgers) << counters_line(state.counters) << pairs_line(state.pair_counts)
              << pieces_line(state.piece_counts) << freeze_line(state.freeze_counts)
              << materials_line(state.material_counts) << std::flush;
  if (!options.fields.empty()) {
    std::filesystem::create_directories(options.fields);
    write_fields(state, options.fields);
  }
  if (!state.ledgers.mass.balances()) throw Violation("the ledger of mass does not balance");
  if (!state.ledgers.energy.balances()) throw Violation("the ledger of energy does not balance");
  if (!state.ledgers.heat.balances()) throw Violation("the ledger of heat does not balance");
}

}  // namespace
}  // namespace oracle

int main(int count, char** words) {
  try {
    oracle::run(oracle::read_options(count, words));
    return 0;
  } catch (const oracle::Violation& violation) {
    std::fflush(stdout);
    std::cerr << "violated: " << violation.what() << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "oracle: " << error.what() << "\n";
    return 2;
  }
}
