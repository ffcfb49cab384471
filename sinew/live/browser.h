// live/browser.h - opening of a page in the user's browser.
#pragma once

#include <filesystem>
#include <string>

namespace sinew::live {

// Opens an address in the browser if there is a graphical session and the address is not "". All
// users of the computer can read the arguments of a command, and the address has a secret token.
// The browser is therefore given a file that only its user may read and that redirects to the
// address. The file is removed by the destructor.
class Browser {
 public:
  explicit Browser(const std::string& url);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

 private:
  std::filesystem::path redirecting_page_;
};

}  // namespace sinew::live
