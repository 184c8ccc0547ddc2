#include <voxmelt/voxmelt.h>

int main() {
  voxmelt::Simulation cello("scenes/cello.toml");
  cello.step(600);
  cello.draw("cello.png");
}
