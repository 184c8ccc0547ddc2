// Tests on random worlds do a sixth of their rounds in ./test.sh, and of lists every third entry. Their slow
// twins do all (voxmelt_test, ALL_ROUNDS).
#pragma once

#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace voxmelt {

inline bool all_rounds() {
  const char* said = std::getenv("VOXMELT_ROUNDS");
  return said != nullptr && std::string_view(said) == "all";
}

// Returns how many of `all` rounds to do, at least one; or how often something must happen in them.
inline int rounds(int all) { return all_rounds() ? all : (all + 5) / 6; }

// Returns a list, or every third of its entries.
template <class List>
auto some_of(const List& all) {
  std::vector<typename List::value_type> some;
  for (std::size_t i = 0; i < all.size(); i += all_rounds() ? 1 : 3) some.push_back(all[i]);
  return some;
}

}  // namespace voxmelt
