// A device and the reference run side by side. After every step they must have the same state and the same
// books. The device follows the rays of heat sources itself, or the host does and sends the irradiance.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "kernel/automaton/state/ledger_difference.h"
#include "kernel/engine/gpu/stepper.h"
#include "kernel/engine/visibility/kept_rays.h"
#include "tests/kernel/engine/parallel/equal.h"

namespace voxmelt::worlds {

using MakeDevice = std::function<std::shared_ptr<gpu::Device>(const Parameters&, Grid)>;

inline step::Implementation on_device(const MakeDevice& make) {
  return {"device", "",
          [make](const Parameters& parameters, Grid grid,
                 const step::Tuning& tuning) -> std::unique_ptr<step::Stepper> {
            return std::make_unique<gpu::Stepper>(make(parameters, grid), parameters, grid, tuning.sleep);
          }};
}

inline bool same_steps_on_device(const Parameters& parameters, const Volume& start, const MakeDevice& make,
                                 int count, bool host_follows_rays = false, bool sleep = true) {
  run::Simulation expected(parameters, start, implementation("reference"));
  std::unique_ptr<visibility::Provider> provider;  // a usual one, whose name a device does not stand for
  if (host_follows_rays)
    provider = std::make_unique<visibility::KeptRays>(std::make_unique<visibility::PlainCaster>());
  run::Simulation actual(parameters, start, on_device(make), {.sleep = sleep}, std::move(provider));
  Volume before = start;
  state::ChangedBricks::Seen seen = actual.volume().changed.now();
  for (int step = 0; step < count; ++step) {
    expected.step();
    actual.step();
    std::string found = difference(expected.volume(), actual.volume());
    if (found.empty()) found = untold(before, seen, actual.volume());
    before = actual.volume();
    seen = actual.volume().changed.now();
    if (found.empty() && expected.ledger() == actual.ledger()) continue;
    const auto books = state::first_difference(expected.ledger(), actual.ledger());
    ADD_FAILURE() << "step " << step << ": " << found
                  << (books ? " " + books->term + " " + state::to_string(books->expected) + " is " +
                                  state::to_string(books->actual)
                            : "");
    return false;
  }
  return true;
}

}  // namespace voxmelt::worlds
