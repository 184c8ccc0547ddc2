// The temperature that no material exceeds follows docs/automaton.md section 6, "Materials".
#include "material.h"

namespace oracle {

Int top_of(const std::vector<Material>& materials) {
  Int top = 65535;
  for (const Material& material : materials) top = smaller(top, material.unbound_temperature(65535));
  return top;
}

}  // namespace oracle
