#include "app/view/address.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <random>

namespace voxmelt::view {

std::string new_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

bool same_secret(std::string_view a, std::string_view b) {
  unsigned char differ = a.size() != b.size();
  for (std::size_t i = 0; i < b.size(); ++i)
    differ |= static_cast<unsigned char>(b[i] ^ (a.empty() ? '\0' : a[i % a.size()]));
  return differ == 0;
}

std::string Address::url() const {
  const bool brackets = host.find(':') != host.npos;
  return fmt::format(fmt::runtime(brackets ? "http://[{}]:{}/{}{}" : "http://{}:{}/{}{}"), host, port,
                     token.empty() ? "" : "?", token);
}

bool Address::is_own(std::string_view wanted_host, std::string_view origin, bool socket) const {
  const bool known =
      wanted_host == fmt::format("127.0.0.1:{}", port) || wanted_host == fmt::format("localhost:{}", port);
  if (token.empty() && !known) return false;
  if (origin.empty()) return !socket;
  return origin == fmt::format("http://{}", wanted_host);
}

// Scripts and styles are no secret. The page and its socket are.
std::string_view Address::target_of(std::string_view target) const {
  const std::size_t mark = std::min(target.find('?'), target.size());
  const std::string_view path = target.substr(0, mark);
  if (token.empty() || (path != "/" && path != "/socket")) return target;
  const std::string_view said = target.substr(std::min(mark + 1, target.size()));
  return same_secret(said, token) ? path : std::string_view();
}

}  // namespace voxmelt::view
