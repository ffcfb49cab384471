// live/server_impl.h - the server as its two halves see it: HTTP in server.cpp, WebSockets in
// server_socket.cpp. Each half takes a compiler long; nobody else includes this.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "sinew/live/server.h"
#include "sinew/live/token.h"

namespace sinew::live {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;
using Error = beast::error_code;
using HttpRequest = http::request<http::string_body>;

inline constexpr std::size_t longest_message = 4 << 10;  // [bytes]

struct Server::Impl : std::enable_shared_from_this<Server::Impl> {
  struct Connection;  // server.cpp
  struct Socket;      // server_socket.cpp

  explicit Impl(Handlers h) : handlers(std::move(h)) {}

  // Makes a WebSocket of the connection that asked for one.
  void upgrade(beast::tcp_stream&& stream, const HttpRequest& request);
  void send_frames();    // to each that is done with the last one
  void leave_sockets();  // without another word

  void listen(Port wanted);
  Error try_to_listen(std::uint16_t port);
  void accept();
  void tick();
  bool make_room();
  bool is_ours(const HttpRequest& request, http::field field, std::string_view before) const;
  bool has_token(std::string_view target) const;

  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io}, end{io}, pause{io};
  asio::signal_set signals{io};
  Handlers handlers;
  std::map<Watcher, std::weak_ptr<Socket>> sockets;
  std::list<Connection*> unauthorized;  // have not shown the token; the oldest first
  const std::string token = random_token();
  Watcher last = 0;
  std::size_t connections = 0;
  std::uint16_t port = 0;
};

}  // namespace sinew::live
