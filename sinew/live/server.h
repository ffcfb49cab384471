// live/server.h - pages over HTTP and WebSocket, for browsers on this machine alone.
//
// Listens on 127.0.0.1. The address has a token, drawn anew by each server: whoever else uses this
// machine can reach the port, but is told nothing and steers nothing. A request whose Host is not
// this server's own name, as of a foreign page whose name was pointed here, is refused, and so is a
// WebSocket that another page opens. GET only; what is served is what `get` answers: there are no
// files. Messages are bounded. One thread. A browser says "ready" when it has dealt with a frame,
// and gets the next one then: one that is slow gets fewer and holds nobody up.
//
// A request that does not come whole within `patience`, or an answer that is not read within it,
// ends its connection. Where there are `most_connections`, the oldest of those that have not shown
// the token is closed for the next one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/live/port.h"

namespace sinew::live {

// The answer to a request over HTTP.
struct Reply {
  int status = 200;
  std::string body;
  std::string type = "text/html; charset=utf-8";
};

class Server {
 public:
  using Watcher = std::uint64_t;  // a WebSocket; never used again

  struct Handlers {
    std::function<Reply(std::string_view path)> get;  // what stands behind the token: "/", "/runs"
    std::function<void()> tick = {};                  // every 40 ms, whether anybody watches or not
    // Of WebSockets; without `frame` there are none. "": nothing to send.
    std::function<std::string(Watcher)> frame = {};  // asked for after each tick
    std::function<std::string(Watcher, std::string_view message)> message = {};
    std::function<void(Watcher)> left = {};
    std::function<void()> interrupted = {};  // by Ctrl-C; without it the server stops
    std::vector<int> signals = {};           // that are as Ctrl-C, SIGTERM and SIGHUP to it
  };

  // Listens from now on. Throws std::runtime_error where the port is taken and none but it will do.
  Server(Port port, Handlers handlers);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Returns where it listens.
  std::uint16_t port() const;
  std::string url() const;  // "http://127.0.0.1:8080/0f…32 digits…/"

  void run();   // until stop(): calls all handlers
  void stop();  // from any thread
  // Sends what waits to be sent, a last frame among it, for at most a moment; then stops.
  void finish();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace sinew::live
