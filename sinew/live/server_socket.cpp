#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>

#include "sinew/live/server_impl.h"

namespace sinew::live {
namespace {

namespace websocket = beast::websocket;

constexpr std::string_view ready = "ready";
constexpr std::size_t most_answers = 32;
constexpr bool compression = false;  // Beast would compile a whole deflate for it

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
        if (self->answers.size() == most_answers) return self->leave();
        self->answers.push_back(std::move(answer));
        self->send();
      }
      self->read();
    });
  }

  // Answers first, then a frame of what there is now, if the last one is done with.
  void send() {
    if (!open || sending) return;
    if (!answers.empty()) {
      out = std::move(answers.front());
      answers.pop_front();
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
      if (!self->answers.empty()) self->send();
    });
  }

  void leave() {
    open = false;
    beast::get_lowest_layer(ws).close();
  }

  std::shared_ptr<Impl> server;
  Watcher id;
  websocket::stream<beast::tcp_stream, compression> ws;
  beast::flat_buffer in;
  std::string out;
  std::deque<std::string> answers;
  bool open = false, sending = false;
  bool waits = true;  // for a frame
};

void Server::Impl::upgrade(beast::tcp_stream&& stream, const HttpRequest& request) {
  std::make_shared<Socket>(shared_from_this(), std::move(stream))->start(request);
}

void Server::Impl::send_frames() {
  const auto all = sockets;  // a frame may be the last of its socket
  for (const auto& [id, socket] : all)
    if (const auto s = socket.lock()) s->send();
}

void Server::Impl::leave_sockets() {
  for (const auto& [id, socket] : std::map(sockets))
    if (const auto s = socket.lock()) s->leave();
}

}  // namespace sinew::live
