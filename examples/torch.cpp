// A torch in the user's hand circles above the scene. After the first half turn a vent pours from it, too.
//   torch SCENE.toml TURNS
#include <voxmelt/voxmelt.h>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 3) return std::cerr << "torch SCENE.toml TURNS\n", 2;
  voxmelt::Simulation simulation(argv[1]);
  const voxmelt::Grid grid = simulation.grid();

  constexpr int kStepsPerTurn = 64, kStepsPerMove = 8;  // by default, shadows are cast every 8th step
  for (int step = 0; step < kStepsPerTurn * std::atoi(argv[2]); step += kStepsPerMove) {
    const double angle = 2 * std::numbers::pi * step / kStepsPerTurn;
    const voxmelt::Position torch{grid.x * (0.5 + 0.4 * std::cos(angle)), 1.0 * grid.y,
                                  grid.z * (0.5 + 0.4 * std::sin(angle))};
    simulation.set_heat_sources({voxmelt::HeatSource::fixed(torch, 60)});
    voxmelt::Vent vent{torch, 3, 0.2, 0.8};
    vent.at[1] -= 4;
    simulation.set_vents(angle < std::numbers::pi ? std::vector<voxmelt::Vent>{} : std::vector{vent});
    simulation.step(kStepsPerMove);
  }
  const voxmelt::Ledgers books = simulation.ledgers();
  for (const voxmelt::Term& term : books.mass.terms)
    std::cout << "mass " << term.name << ' ' << voxmelt::to_string(term.value) << '\n';
  std::cout << "liquid cells " << simulation.state().liquid.count() << '\n';
  return books.balance() ? 0 : 1;
} catch (const voxmelt::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
