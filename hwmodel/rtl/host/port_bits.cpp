#include "hwmodel/rtl/host/port_bits.h"

#include <stdexcept>
#include <string>

namespace voxmelt::hwmodel {
namespace {

// The bits of each port, as the stages declare it.
struct PortBits {
  std::string_view name;
  int bits;
};
constexpr PortBits kPorts[] = {
    {"last", 36},           {"lag", 24},
    {"east", 24},           {"north", 24},
    {"south_east", 24},     {"finished", 24},
    {"counts_axes", 1},     {"finds_walls", 1},
    {"finds_touched", 1},   {"melting_point", 16},
    {"latent_heat", 16},    {"weight", 16},
    {"glow_weights", 48},   {"sky", 16},
    {"freezes_below", 16},  {"reheat", 16},
    {"paper", 1},           {"hot", 1},
    {"printed", 1},         {"factor", 17},
    {"wall_factor", 17},    {"minimum", 16},
    {"hang", 16},           {"beta", 19},
    {"row_blocks", 32},     {"plane_blocks", 32},
    {"eight", 1},           {"support", 1},
    {"downhill", 1},        {"gives_shares", 1},
    {"threshold", 16},      {"margin", 16},
    {"slump", 16},          {"margin_diagonal", 20},
    {"slump_diagonal", 20}, {"alpha", 48},
    {"thermal", 1},         {"mobility_reference", 16},
    {"mobility_rate", 16},  {"yield_stress", 24},
    {"stiffness", 4},       {"last_x", 12},
    {"open_border", 1},     {"by_table", 1},
    {"several", 1},         {"top", 16},
};

}  // namespace

int port_bits(std::string_view name) {
  for (const PortBits& port : kPorts)
    if (port.name == name) return port.bits;
  throw std::logic_error("no stage has a port " + std::string(name));
}

}  // namespace voxmelt::hwmodel
