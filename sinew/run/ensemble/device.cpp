#include "sinew/run/ensemble/device.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "sinew/card/driver.h"
#include "sinew/card/walk.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/card/on_card.h"

namespace sinew::run {

Device parse_device(std::string_view text) {
  if (text == "auto") return {};
  if (text == "cpu") return {.kind = Device::Kind::cpu};
  if (text == "gpu") return {.kind = Device::Kind::gpu};
  if (text.starts_with("gpu:")) {
    Device out{.kind = Device::Kind::gpu};
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + 4, last, out.number);
    if (error == std::errc{} && end == last && out.number >= 0) return out;
  }
  config::fail({"device", 0, 0}, "", config::in_quotes(text),
               "auto, cpu, gpu or gpu:N, the number of a card from 0 on",
               config::closest_in_quotes(text, {"auto", "cpu", "gpu"}));
}

Device chosen(const Device& device) {
  using Kind = Device::Kind;
  if (device.kind == Kind::cpu || device.card) return device;
  const bool automatic = device.kind == Kind::automatic;
  const auto refuse = [&](const std::string& found) -> Device {
    if (automatic) return {.kind = Kind::cpu};
    throw std::runtime_error(
        fmt::format("found {}; expected a usable one for device=gpu:{}; try device=cpu, or "
                    "device=auto",
                    found, device.number));
  };
  std::string problem;
  const std::vector<card::Properties> cards = card::list(problem);
  if (cards.empty()) return refuse("no graphics card: " + problem);
  const auto its = automatic ? cards.begin()
                             : std::ranges::find(cards, device.number, &card::Properties::number);
  if (its == cards.end())
    return refuse(fmt::format("no graphics card of this number, but {} other{}", cards.size(),
                              cards.size() == 1 ? "" : "s"));
  if (card::walk_ptx().empty())
    return refuse("a build without a program for graphics cards, which sinew doctor describes");
  return {device.kind, its->number, std::make_shared<Card>(*its)};
}

std::string name_of(const Device& device) {
  if (!device.card) return "";
  const card::Properties& its = device.card->properties();
  return fmt::format("{} (card {})", its.name, its.number);
}

}  // namespace sinew::run
