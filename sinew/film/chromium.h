// film/chromium.h - a browser without a window that runs JavaScript in a page, over two pipes.
//
//   Chromium browser;
//   browser.open(file);                               // a page on this machine
//   browser.evaluate("document.title");               // "\"Walking\"", as JSON
//
// It uses the protocol of the browser's developer tools. The browser is the user's own Chromium
// or Chrome, in a profile that is made for it and goes with it; it listens on no port and needs no
// network.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace sinew::film {

// Returns the browser's program: what the variable CHROMIUM names, or the first of the usual names
// on the PATH. Empty if it is missing.
std::filesystem::path find_chromium();

// A browser that runs as long as this lives.
class Chromium {
 public:
  // Starts it. Throws std::runtime_error, with what to do, if it is missing or does not
  // start. `stop`: once it is true, whatever waits for the browser throws Stopped.
  explicit Chromium(const std::atomic<bool>& stop);
  ~Chromium();
  Chromium(const Chromium&) = delete;
  Chromium& operator=(const Chromium&) = delete;

  // Opens a page of a file.
  void open(const std::filesystem::path& page);
  // Runs a script in the page and waits for what it promises; returns its value as JSON. Throws
  // std::runtime_error with the words of an exception.
  std::string evaluate(std::string_view script);
  // The value of a script that gives a text.
  std::string text(std::string_view script);

  // A folder for files of this browser's life.
  const std::filesystem::path& folder() const;

  // The work was interrupted.
  struct Stopped : std::runtime_error {
    // Throws that error.
    Stopped() : std::runtime_error("interrupted") {}
  };

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sinew::film
