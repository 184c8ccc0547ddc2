// A token tells which ray it is about, or the first pixel of which tile.
#pragma once

#include <concepts>

#include "hwmodel/caster/model/tokens.h"

namespace voxmelt::hwmodel::raycast {

template <class Token>
concept OfRay = requires(const Token& t) {
  { t.id } -> std::same_as<const RayId&>;
}
|| requires(const Token& t) {
  { t.request.id } -> std::same_as<const RayId&>;
}
|| requires(const Token& t) {
  { t.ray.id } -> std::same_as<const RayId&>;
};
template <class Token>
concept OfTile = requires(const Token& t) {
  t.x, t.y;
};

template <class Token>
requires OfRay<Token> || OfTile<Token> RayId id_of(const Token& token) {
  if constexpr (requires { token.id; }) {
    return token.id;
  } else if constexpr (requires { token.request.id; }) {
    return token.request.id;
  } else if constexpr (requires { token.ray.id; }) {
    return token.ray.id;
  } else {
    return {token.x, token.y, 0, 0};
  }
}

inline bool same_place(const RayId& a, const RayId& b) {
  return a.x == b.x && a.y == b.y && a.sample == b.sample;
}

}  // namespace voxmelt::hwmodel::raycast
