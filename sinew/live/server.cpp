// This is the only source that includes Boost's Asio and Beast, because they compile slowly.
#include "sinew/live/server.h"

#include <fmt/format.h>

#include <sys/random.h>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <csignal>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace sinew::live {

namespace {

// --- token of the address ---

// Returns 128 random bits of the operating system as 32 hexadecimal digits. Throws
// std::runtime_error if it has no random numbers.
std::string random_token() {
  std::array<unsigned char, 16> bits{};
  // A read of up to 256 bytes is never partial.
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size()))
    throw std::runtime_error("the operating system has no random numbers for a token");
  std::string token;
  for (const unsigned char b : bits) token += fmt::format("{:02x}", b);
  return token;
}

// Returns whether two tokens are equal, in a time that depends on their lengths only.
bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

}  // namespace

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;
using Error = beast::error_code;
using HttpRequest = http::request<http::string_body>;

inline constexpr std::size_t longest_message = 4 << 10;  // [bytes]

struct Server::Impl : std::enable_shared_from_this<Server::Impl> {
  struct Connection;  // HTTP
  struct Socket;      // a WebSocket

  explicit Impl(Handlers h) : handlers(std::move(h)) {}

  // Makes a WebSocket of the connection that requested one.
  void upgrade(beast::tcp_stream&& stream, const HttpRequest& request);
  void send_frames();    // to each socket that is ready
  void leave_sockets();  // closes all without a message

  void listen(Port wanted);
  Error try_to_listen(std::uint16_t port);
  void accept();
  void tick();
  bool make_room();
  bool is_own_host(const HttpRequest& request, http::field field, std::string_view before) const;
  bool has_token(std::string_view target) const;

  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io}, end{io}, pause{io};
  asio::signal_set signals{io};
  Handlers handlers;
  std::map<SocketId, std::weak_ptr<Socket>> sockets;
  std::list<Connection*> unauthorized;  // connections without the token, the oldest first
  const std::string token = random_token();
  SocketId last = 0;
  std::size_t connections = 0;
  std::uint16_t port = 0;
};

// --- WebSockets ---

namespace {

namespace websocket = beast::websocket;

constexpr std::string_view ready = "ready";
constexpr std::size_t most_replies = 32;
constexpr bool compression = false;  // avoids the compilation of Beast's deflate

}  // namespace

struct Server::Impl::Socket : std::enable_shared_from_this<Socket> {
  Socket(std::shared_ptr<Impl> s, beast::tcp_stream&& stream)
      : server(std::move(s)), id(++server->last), ws(std::move(stream)) {
    ++server->connections;
  }
  ~Socket() {
    --server->connections;
    if (server->handlers.left) server->handlers.left(id);
    server->sockets.erase(id);
  }

  void start(const HttpRequest& request) {
    beast::get_lowest_layer(ws).expires_never();
    ws.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    ws.read_message_max(longest_message);
    ws.async_accept(request, [self = shared_from_this()](Error error) {
      if (error) return;
      self->server->sockets[self->id] = self;
      self->open = true;
      self->read();
    });
  }

  void read() {
    ws.async_read(in, [self = shared_from_this()](Error error, std::size_t) {
      if (error) return self->leave();
      const std::string text = beast::buffers_to_string(self->in.data());
      self->in.consume(self->in.size());
      if (text == ready) {
        self->waits = true;
        return self->read();
      }
      if (std::string answer = self->server->handlers.message(self->id, text); !answer.empty()) {
        if (self->replies.size() == most_replies) return self->leave();
        self->replies.push_back(std::move(answer));
        self->send();
      }
      self->read();
    });
  }

  // Sends pending replies first, then the current frame if the browser is ready.
  void send() {
    if (!open || sending) return;
    if (!replies.empty()) {
      out = std::move(replies.front());
      replies.pop_front();
    } else if (waits) {
      out = server->handlers.frame(id);
      waits = out.empty();
    } else {
      return;
    }
    if (out.empty()) return;
    sending = true;
    ws.text(true);
    ws.async_write(asio::buffer(out), [self = shared_from_this()](Error error, std::size_t) {
      self->sending = false;
      if (error) return self->leave();
      if (!self->replies.empty()) self->send();
    });
  }

  void leave() {
    open = false;
    beast::get_lowest_layer(ws).close();
  }

  std::shared_ptr<Impl> server;
  SocketId id;
  websocket::stream<beast::tcp_stream, compression> ws;
  beast::flat_buffer in;
  std::string out;
  std::deque<std::string> replies;
  bool open = false, sending = false;
  bool waits = true;  // ready for a frame
};

void Server::Impl::upgrade(beast::tcp_stream&& stream, const HttpRequest& request) {
  std::make_shared<Socket>(shared_from_this(), std::move(stream))->start(request);
}

void Server::Impl::send_frames() {
  const auto all = sockets;  // copied, because sending may remove a socket
  for (const auto& [id, socket] : all)
    if (const auto s = socket.lock()) s->send();
}

void Server::Impl::leave_sockets() {
  for (const auto& [id, socket] : std::map(sockets))
    if (const auto s = socket.lock()) s->leave();
}

namespace {

constexpr auto between_frames = std::chrono::milliseconds(40);
constexpr auto patience = std::chrono::seconds(10);  // longest time for a request or a reply
constexpr auto last_moment = std::chrono::seconds(1);
constexpr std::size_t longest_head = 8 << 10;  // [bytes]
constexpr std::size_t most_connections = 64;

}  // namespace

// --- HTTP ---

struct Server::Impl::Connection : std::enable_shared_from_this<Connection> {
  Connection(std::shared_ptr<Impl> s, tcp::socket&& socket)
      : server(std::move(s)), stream(std::move(socket)) {
    ++server->connections;
    place = server->unauthorized.insert(server->unauthorized.end(), this);
  }
  ~Connection() {
    --server->connections;
    authorize();
  }

  // Removes this from the unauthorized connections.
  void authorize() {
    if (place) server->unauthorized.erase(*place);
    place.reset();
  }

  void read() {
    parser.emplace();
    parser->header_limit(longest_head);
    parser->body_limit(longest_message);
    stream.expires_after(patience);
    http::async_read(stream, buffer, *parser,
                     [self = shared_from_this()](Error error, std::size_t) {
                       if (!error) self->handle(self->parser->release());
                     });
  }

  void handle(HttpRequest request) {
    if (!server->is_own_host(request, http::field::host, ""))
      return write(request, {403, "This server accepts its own host name only.\n", "text/plain"});
    const std::string_view target(request.target().data(), request.target().size());
    if (!server->has_token(target))
      return write(request, {403,
                             "This address lacks its token; open the whole one that sinew view "
                             "printed.\n",
                             "text/plain"});
    authorize();
    const std::string_view path = target.substr(1 + server->token.size());
    if (beast::websocket::is_upgrade(request)) {
      if (!server->handlers.frame || path != "/live" ||
          !server->is_own_host(request, http::field::origin, "http://"))
        return write(request, {403, "Only this server's own page may watch.\n", "text/plain"});
      return server->upgrade(std::move(stream), request);
    }
    const bool head = request.method() == http::verb::head;
    if (request.method() != http::verb::get && !head)
      return write(request, {405, "GET only.\n", "text/plain"});
    if (path.empty())
      return write(request, {404, "The address ends in a slash.\n", "text/plain"}, head);
    write(request, server->handlers.get(path), head);
  }

  void write(const HttpRequest& request, Reply reply, bool head = false) {
    response = {static_cast<http::status>(reply.status), request.version()};
    response.set(http::field::content_type, reply.type);
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.set(http::field::x_frame_options, "DENY");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set("Referrer-Policy", "no-referrer");
    response.keep_alive(request.keep_alive() && reply.status == 200);
    response.body() = std::move(reply.body);
    response.prepare_payload();
    if (head) response.body().clear();
    stream.expires_after(patience);
    http::async_write(stream, response,
                      [self = shared_from_this(), keep = response.keep_alive() && !head](
                          Error error, std::size_t) {
                        if (error) return;
                        if (keep) return self->read();
                        Error ignored;
                        self->stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  std::shared_ptr<Impl> server;
  std::optional<std::list<Connection*>::iterator> place;  // position in `unauthorized`
  beast::tcp_stream stream;
  beast::flat_buffer buffer;
  std::optional<http::request_parser<http::string_body>> parser;
  http::response<http::string_body> response;
};

// --- the server ---

// Returns whether a header field occurs once and has this server's name, after `before`.
bool Server::Impl::is_own_host(const HttpRequest& request, http::field field,
                               std::string_view before) const {
  if (request.count(field) != 1) return false;
  const auto value = request[field];
  for (const std::string_view host : {"127.0.0.1", "localhost"})
    if (value == fmt::format("{}{}:{}", before, host, port)) return true;
  return false;
}

// Returns whether the target begins with the token.
bool Server::Impl::has_token(std::string_view target) const {
  if (target.empty() || target[0] != '/') return false;
  const std::string_view shown = target.substr(1, token.size());
  const std::string_view rest = target.substr(1 + shown.size());
  return same_token(shown, token) && (rest.empty() || rest[0] == '/');
}

Error Server::Impl::try_to_listen(std::uint16_t number) {
  const tcp::endpoint here(asio::ip::address_v4::loopback(), number);
  Error error, ignored;
  acceptor.close(ignored);
  acceptor.open(here.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(here, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  return error;
}

void Server::Impl::listen(Port wanted) {
  Error error = try_to_listen(wanted.number);
  if (error && wanted.or_free) error = try_to_listen(0);
  if (error)
    throw std::runtime_error(fmt::format("port: found {}: {}; expected a free port; try port=0",
                                         wanted.number, error.message()));
  port = acceptor.local_endpoint().port();
  accept();
}

void Server::Impl::accept() {
  acceptor.async_accept([self = shared_from_this()](Error error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      if (self->make_room()) std::make_shared<Connection>(self, std::move(socket))->read();
      return self->accept();
    }
    // Retries later, because an error such as a lack of file descriptors persists for a while.
    self->pause.expires_after(between_frames);
    self->pause.async_wait([self](Error stopped) {
      if (!stopped) self->accept();
    });
  });
}

// Returns whether one more connection is allowed. If there are too many, the oldest one that has
// not sent the token is closed; one that has sent it never is.
bool Server::Impl::make_room() {
  if (connections < most_connections) return true;
  if (unauthorized.empty()) return false;
  Connection& oldest = *unauthorized.front();
  oldest.authorize();  // still counted until it is destroyed
  oldest.stream.close();
  return true;
}

void Server::Impl::tick() {
  timer.expires_after(between_frames);
  timer.async_wait([self = shared_from_this()](Error error) {
    if (error) return;
    if (self->handlers.tick) self->handlers.tick();
    self->send_frames();
    self->tick();
  });
}

Server::Server(Port port, Handlers handlers) : impl_(std::make_shared<Impl>(std::move(handlers))) {
  impl_->listen(port);
  impl_->signals.add(SIGINT);
  impl_->signals.add(SIGTERM);
  impl_->signals.add(SIGHUP);
  for (const int more : impl_->handlers.signals) impl_->signals.add(more);
}

// Cancels all pending operations, because each of them owns a reference to the server.
Server::~Server() {
  impl_->handlers.left = {};
  Error ignored;
  impl_->acceptor.close(ignored);
  impl_->timer.cancel();
  impl_->end.cancel();
  impl_->pause.cancel();
  impl_->signals.cancel(ignored);
  impl_->leave_sockets();
  impl_->io.restart();
  impl_->io.run_for(last_moment);
}

std::uint16_t Server::port() const { return impl_->port; }

std::string Server::url() const {
  return fmt::format("http://127.0.0.1:{}/{}/", port(), impl_->token);
}

void Server::run() {
  const auto wait = [this](auto&& again) -> void {
    impl_->signals.async_wait([this, again](Error error, int) {
      if (error) return;
      again(again);
      if (impl_->handlers.interrupted)
        impl_->handlers.interrupted();
      else
        stop();
    });
  };
  wait(wait);
  if (impl_->handlers.frame) impl_->tick();
  impl_->io.run();
}

void Server::stop() { impl_->io.stop(); }

void Server::finish() {
  asio::post(impl_->io, [impl = impl_] {
    impl->end.expires_after(last_moment);
    impl->end.async_wait([impl](Error error) {
      if (!error) impl->io.stop();
    });
  });
}

namespace {

constexpr std::uint32_t first = 20000, count = 10000;

// FNV-1a hash, which is the same on every computer and with every library.
std::uint32_t hash(const std::string& text) {
  std::uint32_t out = 2166136261u;
  for (const char c : text) out = (out ^ static_cast<unsigned char>(c)) * 16777619u;
  return out;
}

}  // namespace

Port folder_port(const std::filesystem::path& folder) {
  std::error_code gone;
  std::filesystem::path whole = std::filesystem::weakly_canonical(folder, gone);
  if (!whole.has_filename()) whole = whole.parent_path();  // "/home/me/" is "/home/me"
  const std::string name = (gone ? folder : whole).string();
  return {.number = static_cast<std::uint16_t>(first + hash(name) % count), .or_free = true};
}

}  // namespace sinew::live
