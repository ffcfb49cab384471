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
  std::vector<std::string_view> names;
  for (const Item& item : items) {
    if (item.name == name) return item;
    names.push_back(item.name);
  }
  const std::string no = "no " + std::string(what);
  const std::string_view near = config::closest(name, names);
  config::fail({std::string(option), 0, 0}, "",
               items.empty()  ? no + " in the file"
               : name.empty() ? no
                              : config::in_quotes(name),
               items.empty() ? "a file with one" : config::either(names),
               near.empty() ? "" : config::in_quotes(near));
}

}  // namespace sinew::cli
