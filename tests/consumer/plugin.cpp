// A module that a program opens while it runs, as Python does: the library is part of it.
#include <voxmelt/voxmelt.h>

#include <cstdint>
#include <exception>

// Returns the digest of a scene after so many steps, or 0 after an error.
extern "C" __attribute__((visibility("default"))) std::uint64_t digest_of(const char* scene,
                                                                          std::uint32_t steps) noexcept {
  try {
    voxmelt::Simulation simulation(scene);
    simulation.step(steps);
    return simulation.digest();
  } catch (const std::exception&) {
    return 0;
  }
}
