#include "sinew/config/lookup.h"

#include <algorithm>
#include <charconv>

namespace sinew::config {

const Node* value_at(const Node& root, std::string_view path) {
  const Node* node = &root;
  while (node && !path.empty()) {
    const std::size_t end = std::min(path.find('.'), path.size());
    std::string_view segment = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));

    const std::size_t bracket = segment.find('[');
    node = node->find(segment.substr(0, bracket));
    if (!node || bracket == segment.npos) continue;
    std::size_t index = 0;
    std::from_chars(segment.data() + bracket + 1, segment.data() + segment.size(), index);
    node = index < node->children.size() ? &node->children[index] : nullptr;
  }
  return node;
}

}  // namespace sinew::config
