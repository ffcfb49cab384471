// cli/named.h - one of a list by its name; the only one needs no name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::cli {

template <class Item>
const Item& named(const std::vector<Item>& items, const std::string& name, std::string_view option,
                  std::string_view what) {
  if (name.empty() && items.size() == 1) return items.front();
  for (const Item& item : items)
    if (item.name == name) return item;
  const std::vector<std::string_view> names = config::names_of(items);
  const std::string no = "no " + std::string(what);
  config::fail({std::string(option), 0, 0}, "",
               items.empty()  ? no + " in the file"
               : name.empty() ? no
                              : config::in_quotes(name),
               items.empty() ? "a file with one" : config::either(names),
               config::closest_in_quotes(name, names));
}

}  // namespace sinew::cli
