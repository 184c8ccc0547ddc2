// Where the server listens, and what a request must have to come from its own page.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace voxmelt::view {

// Returns 128 bits by chance, as 32 hexadecimal digits.
std::string new_token();
// Compares in a time that tells nothing of where the two differ.
bool same_secret(std::string_view a, std::string_view b);

struct Address {
  std::string host = "127.0.0.1";  // a number; the loopback address needs no token
  std::uint16_t port = 0;          // 0 takes any that is free
  std::string token;               // empty for none

  std::string url() const;
  // Tells if Host and Origin are those of a request of this page. A browser sends `origin` with each
  // WebSocket; an empty one is missing. Without a token, Host must be a name of the loopback address, so that
  // no name of another site can lead here.
  bool is_own(std::string_view wanted_host, std::string_view origin, bool socket) const;
  // Takes the token off a target such as "/?TOKEN". It returns nothing if the token is wrong.
  std::string_view target_of(std::string_view target) const;
};

}  // namespace voxmelt::view
