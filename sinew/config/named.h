// config/named.h - one of a list by its name; the only one needs no name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

// Returns the item of that name, or the only one where the name is "". Throws Error that begins
// with `where`: a file, a key or an option; `what` is what the items are, "valve".
template <class Item>
const Item& named(const std::vector<Item>& items, const std::string& name, std::string_view where,
                  std::string_view what) {
  if (name.empty() && items.size() == 1) return items.front();
  for (const Item& item : items)
    if (item.name == name) return item;
  const std::vector<std::string_view> names = names_of(items);
  const std::string no = "no " + std::string(what);
  fail({std::string(where), 0, 0}, "",
       items.empty()  ? no + " in the file"
       : name.empty() ? no
                      : in_quotes(name),
       items.empty() ? "a file with one" : either(names), closest_in_quotes(name, names));
}

}  // namespace sinew::config
