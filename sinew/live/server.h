// live/server.h - pages over HTTP and WebSocket, for browsers on this computer only.
//
// It listens on 127.0.0.1. The address has a random token, so that other users of the computer can
// connect to the port but neither read pages nor control runs. Requests with another Host header,
// as after DNS rebinding, and WebSockets opened by other pages are refused. Only GET and HEAD are
// allowed; all content comes from `get`, never from files. Messages are limited in size. It uses
// one thread. A browser sends "ready" when it has processed a frame and then gets the next one: a
// slow one gets fewer frames and does not delay others.
//
// A request that is not complete within `patience`, or a reply that is not read within it, ends its
// connection. At `most_connections` the oldest one that has not sent the token is closed for a new
// one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::live {

// Port of a server on 127.0.0.1. A browser stores the settings of a page by address and port, so a
// page keeps them only if its port stays: folder_port() gives each folder its own.
struct Port {
  std::uint16_t number = 0;  // 0: a free one
  bool or_free = false;      // use a free one if the number is taken; otherwise that is an error
};

// Returns the port of a folder, the same each time, or a free one while another program uses it. It
// is below the range of ephemeral ports.
Port folder_port(const std::filesystem::path& folder);

// Reply to a request over HTTP.
struct Reply {
  int status = 200;
  std::string body;
  std::string type = "text/html; charset=utf-8";
};

class Server {
 public:
  using SocketId = std::uint64_t;  // number of a WebSocket, never reused

  struct Handlers {
    std::function<Reply(std::string_view path)> get;  // path after the token: "/", "/runs"
    std::function<void()> tick = {};                  // every 40 ms, also without connections
    // For WebSockets, which are refused without `frame`. Both return "" to send nothing.
    std::function<std::string(SocketId)> frame = {};  // called after each tick
    std::function<std::string(SocketId, std::string_view message)> message = {};
    std::function<void(SocketId)> left = {};
    std::function<void()> interrupted = {};  // called on Ctrl-C; without it the server stops
    std::vector<int> signals = {};           // handled like Ctrl-C, SIGTERM and SIGHUP
  };

  // Listens from now on. Throws std::runtime_error if the port is taken and no other is allowed.
  Server(Port port, Handlers handlers);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const;  // TCP port that it listens on
  std::string url() const;     // "http://127.0.0.1:8080/0f…32 digits…/"

  void run();   // serves until stop() and calls all handlers
  void stop();  // callable from any thread
  // Sends pending messages and a last frame, for at most 1 s; then stops.
  void finish();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace sinew::live
