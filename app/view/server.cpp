#include "app/view/server.h"

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <utility>  // Boost 1.74 needs it before its own headers

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <string_view>

#include "app/view/page_files.h"

namespace voxmelt::view {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = net::ip::tcp;
using Error = boost::system::error_code;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

constexpr std::size_t kMostConnections = 64, kLongestLine = 512, kMostWaiting = 256;
constexpr std::uint32_t kLargestHead = 8192;
constexpr int kMostLinesASecond = 400;
constexpr std::chrono::seconds kPatience{20};

std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

Response answer(const Request& request, http::status status, std::string_view type, std::string_view text) {
  Response response(status, request.version());
  response.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Content-Security-Policy", "default-src 'self'; img-src 'self' blob:; frame-ancestors 'none'");
  response.keep_alive(false);
  if (request.method() != http::verb::head) response.body() = text;
  response.prepare_payload();
  return response;
}

// Counts the lines of the last second.
class Rate {
 public:
  bool too_many() {
    const auto now = std::chrono::steady_clock::now();
    if (now - begin_ > std::chrono::seconds(1)) {
      begin_ = now;
      lines_ = 0;
    }
    return ++lines_ > kMostLinesASecond;
  }

 private:
  std::chrono::steady_clock::time_point begin_{};
  int lines_ = 0;
};

}  // namespace

class Server::Net {
 public:
  Net(const Address& address, Audience audience)
      : address_(address), audience_(std::move(audience)), acceptor_(context_) {
    Error error;
    const tcp::endpoint place(net::ip::make_address(address.host, error), address.port);
    if (error) throw InputError(fmt::format("error: --listen {}: is no address in numbers", address.host));
    acceptor_.open(place.protocol(), error);
    if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(place, error);
    if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
    if (error)
      throw OutputError(fmt::format("error: cannot listen on port {}: {}", address.port, error.message()));
    address_.port = acceptor_.local_endpoint().port();
    net::co_spawn(context_, listen(), net::detached);
  }

  const Address& address() const { return address_; }
  void run() { context_.run(); }
  void stop() { context_.stop(); }

  void send(std::optional<Client> client, const MessagePtr& message) {
    net::post(context_, [this, client, message] {
      for (auto& [number, page] : pages_)
        if (!client || *client == number) page->offer(message);
    });
  }

 private:
  // Is a browser's page, with what waits to be sent to it.
  struct Page {
    explicit Page(tcp::socket&& socket)
        : stream(std::move(socket)), news(stream.get_executor(), net::steady_timer::time_point::max()) {}

    // Only the newest frame waits. All else is sent in order, as long as the page reads at all.
    void offer(const MessagePtr& message) {
      if (message->kind == Message::Kind::frame) {
        dropped += frame != nullptr;
        frame = message;
      } else if (message->kind == Message::Kind::textures) {
        textures = message;  // the page has asked for it, and asks for no other one meanwhile
      } else if (texts.size() < kMostWaiting) {
        texts.push_back(message);
      }
      news.cancel();
    }
    MessagePtr take() {
      MessagePtr next;
      if (told != dropped) {
        told = dropped;
        next = std::make_shared<const Message>(
            Message{fmt::format(R"({{"type":"dropped","frames":{}}})", dropped), Message::Kind::text});
      } else if (!texts.empty()) {
        next = texts.front();
        texts.pop_front();
      } else {
        next.swap(textures ? textures : frame);
      }
      return next;
    }

    websocket::stream<beast::tcp_stream> stream;
    net::steady_timer news;
    std::deque<MessagePtr> texts;
    MessagePtr frame, textures;
    std::uint64_t dropped = 0, told = 0;  // frames
    bool open = true;
  };

  net::awaitable<void> listen() {
    for (;;) {
      Error error;
      tcp::socket socket = co_await acceptor_.async_accept(net::redirect_error(net::use_awaitable, error));
      if (error) co_return;
      if (connections_ >= kMostConnections) continue;  // it is closed at once
      ++connections_;
      net::co_spawn(context_, serve(std::move(socket)),
                    [this](const std::exception_ptr&) { --connections_; });
    }
  }

  net::awaitable<void> serve(tcp::socket socket) {
    beast::tcp_stream stream(std::move(socket));
    stream.expires_after(kPatience);
    beast::flat_buffer buffer;
    http::request_parser<http::empty_body> parser;
    parser.header_limit(kLargestHead);
    parser.body_limit(0);
    Error error;
    co_await http::async_read(stream, buffer, parser, net::redirect_error(net::use_awaitable, error));
    if (error == http::error::end_of_stream || error == beast::error::timeout) co_return;
    const Request request = parser.get();
    if (error) {
      co_await reply(stream, answer(request, http::status::bad_request, "text/plain",
                                    "A request was not understood.\n"));
    } else if (!is_for_us(request)) {
      co_await reply(stream, answer(request, http::status::forbidden, "text/plain",
                                    "This server answers requests of its own page alone.\n"));
    } else if (websocket::is_upgrade(request) && target_of(request) == "/socket") {
      co_await talk(stream.release_socket(), request);
    } else {
      co_await reply(stream, file(request));
    }
  }

  net::awaitable<void> reply(beast::tcp_stream& stream, Response response) {
    Error error;
    co_await http::async_write(stream, response, net::redirect_error(net::use_awaitable, error));
    stream.socket().shutdown(tcp::socket::shutdown_send, error);
  }

  bool is_for_us(const Request& request) const {
    return address_.is_own(text_of(request[http::field::host]), text_of(request[http::field::origin]),
                           websocket::is_upgrade(request)) &&
           !target_of(request).empty();
  }
  std::string_view target_of(const Request& request) const {
    return address_.target_of(text_of(request.target()));
  }

  Response file(const Request& request) const {
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return answer(request, http::status::method_not_allowed, "text/plain", "Pages are only read.\n");
    for (const PageFile& page : page_files())
      if (target_of(request) == page.target) return answer(request, http::status::ok, page.type, page.text);
    return answer(request, http::status::not_found, "text/plain", "There is no such page.\n");
  }

  net::awaitable<void> talk(tcp::socket socket, Request request) {
    const auto page = std::make_shared<Page>(std::move(socket));
    websocket::stream<beast::tcp_stream>& stream = page->stream;
    beast::get_lowest_layer(stream).expires_never();
    stream.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream.read_message_max(kLongestLine);
    stream.auto_fragment(false);
    Error error;
    co_await stream.async_accept(request, net::redirect_error(net::use_awaitable, error));
    if (error) co_return;
    const Client client = ++last_client_;
    pages_[client] = page;
    net::co_spawn(context_, write(page), net::detached);
    audience_.came(client);
    co_await read(client, page);
    page->open = false;
    page->news.cancel();
    pages_.erase(client);
    audience_.left(client);
  }

  net::awaitable<void> read(Client client, std::shared_ptr<Page> page) {
    Rate rate;
    for (;;) {
      beast::flat_buffer buffer;
      Error error;
      co_await page->stream.async_read(buffer, net::redirect_error(net::use_awaitable, error));
      if (error) co_return;
      const bool plain = page->stream.got_text() && !rate.too_many();
      std::string line = beast::buffers_to_string(buffer.data());
      if (!plain || line.empty() || line.find('\n') != line.npos) {
        const websocket::close_reason why(websocket::close_code::policy_error,
                                          "a line of text, and not too many");
        co_await page->stream.async_close(why, net::redirect_error(net::use_awaitable, error));
        co_return;
      }
      audience_.said(client, std::move(line));
    }
  }

  net::awaitable<void> write(std::shared_ptr<Page> page) {
    while (page->open) {
      const MessagePtr message = page->take();
      Error error;
      if (!message) {
        page->news.expires_at(net::steady_timer::time_point::max());
        co_await page->news.async_wait(net::redirect_error(net::use_awaitable, error));
        continue;
      }
      page->stream.binary(message->kind != Message::Kind::text);
      co_await page->stream.async_write(net::buffer(message->bytes),
                                        net::redirect_error(net::use_awaitable, error));
      if (error) co_return;
    }
  }

  Address address_;
  Audience audience_;
  net::io_context context_{1};
  tcp::acceptor acceptor_;
  std::size_t connections_ = 0;
  Client last_client_ = 0;
  std::map<Client, std::shared_ptr<Page>> pages_;
};

Server::Server(const Address& address, Audience audience)
    : net_(std::make_unique<Net>(address, std::move(audience))) {}
Server::~Server() = default;
const Address& Server::address() const { return net_->address(); }
void Server::run() { net_->run(); }
void Server::stop() { net_->stop(); }
void Server::send(std::optional<Client> client, const MessagePtr& message) { net_->send(client, message); }

}  // namespace voxmelt::view
