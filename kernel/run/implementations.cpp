#include "kernel/run/implementations.h"

#include "kernel/engine/gpu/devices.h"
#include "kernel/engine/parallel/stepper.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::run {

const step::Registry& implementations() {
  static const step::Registry all = [] {
    step::Registry registry;
    scalar::add_implementations(registry);
    parallel::add_implementations(registry);
    return registry;
  }();
  return all;
}

const step::Registry& devices() {
  static const step::Registry all = [] {
    step::Registry registry;
    gpu::add_implementations(registry);
    return registry;
  }();
  return all;
}

std::string missing_for_cuda() { return gpu::missing_for_cuda(); }

}  // namespace voxmelt::run
