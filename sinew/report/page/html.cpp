#include "sinew/report/page/html.h"

#include "sinew/config/utf8.h"

namespace sinew::report {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : config::in_utf8(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace sinew::report
