// One page has the hands: it alone steps, looks around and changes. The others look on, and may ask for them.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "app/view/client.h"

namespace voxmelt::view {

class Hands {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPatience{5};

  // The first page that is here has the hands. If it leaves, the next one gets them.
  void come(Client client) { pages_.push_back(client); }
  void leave(Client client) {
    std::erase(pages_, client);
    if (asker_ == client) asker_.reset();
  }
  bool has(Client client) const { return !pages_.empty() && pages_.front() == client; }
  const std::vector<Client>& pages() const { return pages_; }

  // A page that is asked may be gone without a word. So who asks again after a while gets them.
  void ask(Client client, Clock::time_point now) {
    if (has(client)) return;
    if (asker_ != client) {
      asker_ = client;
      asked_at_ = now;
    } else if (now - asked_at_ >= kPatience) {
      give();
    }
  }
  bool asked(Client client) const { return has(client) && asker_.has_value(); }
  // Gives them to the page that asked last. Nothing happens if none did.
  void give() {
    if (!asker_) return;
    const auto to = std::find(pages_.begin(), pages_.end(), *asker_);
    std::rotate(pages_.begin(), to, to + 1);
    asker_.reset();
  }

  // Tells which words everybody may say.
  static bool are_needed(std::string_view word) {
    for (const std::string_view free : {"pick", "save", "exact", "textures", "hands"})
      if (word == free) return false;
    return true;
  }

 private:
  std::vector<Client> pages_;  // the one with the hands first
  std::optional<Client> asker_;
  Clock::time_point asked_at_{};
};

}  // namespace voxmelt::view
