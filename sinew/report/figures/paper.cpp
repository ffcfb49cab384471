#include "sinew/report/figures/paper.h"

#include <charconv>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"

namespace sinew::report {
namespace {

constexpr double point = 0.0254 / 72;  // [m]
constexpr config::Range widths{0.03, 1, "from a figure within the text to a poster"};
constexpr config::Range heights{0.02, 1.5, "from a strip to a poster"};

double length(std::string_view name, const std::string& text, const config::Range& range) {
  return config::quantity_setting(name, text, "m", units::atmosphere, range) / point;
}

// "9 pt", or the number alone: nobody measures letters in anything else.
double letters_of(const std::string& text) {
  std::string_view rest = config::trimmed(text);
  double size = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), size);
  const std::string_view unit =
      config::trimmed(rest.substr(static_cast<std::size_t>(end - rest.data())));
  if (error != std::errc() || (!unit.empty() && unit != "pt"))
    config::fail({"font", 0, 0}, "", config::in_quotes(text), "the size of letters in points",
                 "\"9 pt\"");
  if (!(size >= 4 && size <= 40))
    config::fail({"font", 0, 0}, "", config::in_quotes(text),
                 "4 pt to 40 pt, from what can just be read to a poster", "\"9 pt\"");
  return size;
}

}  // namespace

Paper read_paper(const std::string& width, const std::string& height, const std::string& font) {
  Paper out;
  if (!width.empty()) out.width = length("width", width, widths);
  if (!height.empty()) out.height = length("height", height, heights);
  if (!font.empty()) out.font = letters_of(font);
  return out;
}

}  // namespace sinew::report
