// A key of [hw] gives a number of a machine's configuration its name and its range. Each machine lists its
// keys in one table, and files, --set, help texts and reports follow it.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

namespace voxmelt::hwmodel {

template <class Configuration>
struct Key {
  std::string_view name;    // in [hw], --set, JSON and CSV
  std::int64_t low, high;   // its range
  std::string_view values;  // the range as a reader sees it
  bool power_of_two;
  std::int64_t (*get)(const Configuration&);
  void (*set)(Configuration&, std::int64_t);

  std::int64_t usual() const { return get(Configuration{}); }
  // Tells whether a designer chooses the number. The stall seed only tests the channels.
  bool chosen() const { return name != "stall_seed"; }
};

namespace key_detail {

template <class Owner, class Member>
Owner owner_of(Member Owner::*);

template <auto First, auto... Rest>
constexpr auto& member(auto& owner) {
  if constexpr (sizeof...(Rest) == 0)
    return owner.*First;
  else
    return member<Rest...>(owner.*First);
}

}  // namespace key_detail

// Makes the key of a member of the configuration, or of a member of such a member.
template <auto First, auto... Rest>
constexpr auto hw_key(std::string_view name, std::int64_t low, std::int64_t high,
                      std::string_view values = {}, bool power_of_two = false) {
  using Configuration = decltype(key_detail::owner_of(First));
  return Key<Configuration>{
      name,
      low,
      high,
      values,
      power_of_two,
      [](const Configuration& c) { return static_cast<std::int64_t>(key_detail::member<First, Rest...>(c)); },
      [](Configuration& c, std::int64_t value) {
        auto& number = key_detail::member<First, Rest...>(c);
        number = static_cast<std::remove_reference_t<decltype(number)>>(value);
      }};
}

}  // namespace voxmelt::hwmodel
