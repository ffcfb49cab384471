// live/browser.h - a page in the browser of whoever sits here.
#pragma once

#include <filesystem>
#include <string>

namespace sinew::live {

// Opens the address, if somebody sits here and it is not "". The words of a command can be read by
// everybody on the machine and the address has a token, so the browser is given a file that its
// user alone may read and that leads to the address. It is removed with this.
class Browser {
 public:
  // Opens the page, where there is somebody to see it.
  explicit Browser(const std::string& url);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

 private:
  std::filesystem::path redirecting_page_;
};

}  // namespace sinew::live
