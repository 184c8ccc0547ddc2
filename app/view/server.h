// The server gives a page and its files to browsers, and carries messages over their WebSockets. One thread
// runs it. Only it knows Boost.Beast.
//
// It listens on the loopback address. A request whose Host or Origin is another one is refused, so that no
// page of another site may drive it. Nothing that a page says names a file.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/view/address.h"
#include "app/view/session.h"

namespace voxmelt::view {

// Is told by the server's thread.
struct Audience {
  std::function<void(Client)> came;
  std::function<void(Client, std::string line)> said;
  std::function<void(Client)> left;
};

class Server {
 public:
  // Throws OutputError if the address and the port cannot be had.
  Server(const Address& address, Audience audience);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  const Address& address() const;  // with the port that was had
  void run();                      // until stop()
  void stop();                     // any thread

  // Any thread. A page that is too slow for frames gets the newest one: those between are dropped.
  void send(std::optional<Client> client, const MessagePtr& message);

 private:
  class Net;
  std::unique_ptr<Net> net_;
};

}  // namespace voxmelt::view
