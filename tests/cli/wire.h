// tests/cli/wire.h - a client of `sinew view`: sockets, HTTP and WebSockets written by hand.
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <string>

namespace sinew::test {

// Of "http://127.0.0.1:8080/TOKEN/": the port, and the path from its first "/" on.
inline int port_of(const std::string& url) { return std::stoi(url.substr(url.rfind(':') + 1)); }
inline std::string path_of(const std::string& url) {
  return url.substr(url.find('/', url.rfind(':')));
}

inline std::string host_at(int port) { return "127.0.0.1:" + std::to_string(port); }
inline std::string request_to(int port, const std::string& path, const std::string& more = "") {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host_at(port) + "\r\n" + more + "\r\n";
}
inline std::string upgrade_to(int port, const std::string& path) {
  return request_to(port, path,
                    "Origin: http://" + host_at(port) +
                        "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Key: "
                        "c2luZXcgaXMgd2F0Y2hlZA==\r\nSec-WebSocket-Version: 13\r\n");
}

// A message of a WebSocket that is shorter than 126 bytes, masked with zeros.
inline std::string masked(const std::string& text) {
  return std::string{'\x81', static_cast<char>(0x80 | text.size()), 0, 0, 0, 0} + text;
}

// A connection without any authentication.
class Wire {
 public:
  explicit Wire(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~Wire() { ::close(socket_); }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  void send(const std::string& text) {
    if (open_) open_ = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) >= 0;
  }

  // Returns what arrives until it contains the text, the other side closes, or the time is over.
  std::string hear(const std::string& words, std::chrono::seconds at_most) {
    const auto until = std::chrono::steady_clock::now() + at_most;
    std::string all;
    while (!closed_ && std::chrono::steady_clock::now() < until &&
           (words.empty() || all.find(words) == all.npos)) {
      const timeval patience{0, 50000};
      setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
      char piece[4096];
      const ssize_t n = ::recv(socket_, piece, sizeof piece, 0);
      if (n > 0) all.append(piece, static_cast<std::size_t>(n));
      closed_ = n == 0 || (n < 0 && errno != EAGAIN && errno != EWOULDBLOCK);
    }
    return all;
  }
  bool closed() const { return closed_; }

 private:
  int socket_;
  bool open_ = false, closed_ = false;
};

}  // namespace sinew::test
