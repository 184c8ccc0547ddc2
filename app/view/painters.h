// Each page has painters: the server's, whose frames are exact, its own, which draws from textures, or both.
//
// A page asks for textures and says which version it holds. It gets one message with all that has changed
// since then, and nothing more until it asks again. So a slow page skips versions, and loses no brick.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "app/view/client.h"

namespace voxmelt::view {

class Painters {
 public:
  void come(Client client) { pages_[client] = {}; }
  void leave(Client client) { pages_.erase(client); }
  void want_exact(Client client, bool exact) { pages_[client].exact = exact; }
  // The page holds that version of the textures, or 0 for none, and takes a newer one.
  void ask(Client client, std::uint64_t held) {
    Page& page = pages_[client];
    page.asks = true;
    page.held = held;
    page.behind = page.behind || held == 0;
  }
  // There is something new to be seen.
  void note_news() {
    for (auto& [client, page] : pages_) page.behind = true;
  }

  // Tells whether a frame is wanted. Somebody may come for it at any time if nobody is here.
  bool draw_exact() const { return pages_.empty() || !exact_pages().empty(); }
  std::vector<Client> exact_pages() const {
    std::vector<Client> found;
    for (const auto& [client, page] : pages_)
      if (page.exact) found.push_back(client);
    return found;
  }

  // Calls send(client, held) for each page that waits for what is new.
  template <class SendTo>
  void serve(const SendTo& send) {
    for (auto& [client, page] : pages_) {
      if (!page.asks || !page.behind) continue;
      page.asks = page.behind = false;  // also if it cannot be sent
      send(client, page.held);
    }
  }

 private:
  struct Page {
    bool exact = true, asks = false, behind = true;
    std::uint64_t held = 0;
  };
  std::map<Client, Page> pages_;
};

}  // namespace voxmelt::view
