#include "kernel/run/io/csv.h"

#include <array>
#include <charconv>
#include <functional>
#include <string>

#include "kernel/automaton/state/ledger.h"
#include "kernel/run/io/file_writer.h"

namespace voxmelt::io {
namespace {

using state::Sum;

std::string short_of(double number) {
  constexpr int kDigits = 6;      // that count
  std::array<char, 32> digits{};  // ends in a zero, because such a number has at most 12 characters
  std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::general, kDigits);
  return digits.data();
}

// Gives the name and the sum of each column of the books, quantity after quantity.
using Take = std::function<void(const std::string& name, Sum value)>;

template <template <class> class Terms>
void each_of(const std::string& quantity, const state::LedgerOf<Terms>& ledger, Sum held, const Take& take) {
  take(quantity, held);
  take(quantity + "_start", ledger.start);
  for (const auto& term : Terms<Sum>::table())
    take(quantity + "_" + std::string(term.name), term.sign * (ledger.*term.value));
}

void each_column(const state::Ledger& ledger, const state::Holdings& held, const Take& take) {
  each_of("mass", ledger.mass, held.solid + held.liquid, take);
  each_of("energy", ledger.energy, held.energy, take);
  each_of("heat", ledger.heat, held.heat, take);
}

}  // namespace

std::string csv_head() {
  std::string line = "step,seconds_per_step,solid_cells,liquid_cells,solid_mass,liquid_mass";
  each_column({}, {}, [&](const std::string& name, Sum) { line.append(1, ',').append(name); });
  return line + "\n";
}

std::string csv_row(const Moment& moment) {
  const state::Volume& volume = moment.volume;
  const state::Holdings held = state::holdings(volume);
  std::string line = std::to_string(moment.step) + "," + short_of(moment.seconds_per_step);
  for (const Sum count : {Sum(volume.solid.count()), Sum(volume.liquid.count()), held.solid, held.liquid})
    line.append(1, ',').append(state::to_string(count));
  const state::Ledger books = moment.ledger != nullptr ? *moment.ledger : state::Ledger::open(volume);
  each_column(books, held,
              [&](const std::string&, Sum value) { line.append(1, ',').append(state::to_string(value)); });
  return line + "\n";
}

void export_csv(const Moment& moment, const std::filesystem::path& folder, const Poll&) {
  write_file(folder / kCsvFile, csv_head() + csv_row(moment));
}

}  // namespace voxmelt::io
