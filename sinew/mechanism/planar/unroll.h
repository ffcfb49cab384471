// mechanism/planar/unroll.h - loops over so few that each turn is written out: compilers leave
// nested ones over matrices of three or four rows as loops, which cost more than what is in them.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace sinew::plant {

// Visits 0 ... Count - 1, each as a constant of its own type.
template <std::size_t Count, class Visit>
[[gnu::always_inline]] constexpr void unroll(Visit visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (visit(std::integral_constant<std::size_t, I>{}), ...);
  }
  (std::make_index_sequence<Count>{});
}

}  // namespace sinew::plant
