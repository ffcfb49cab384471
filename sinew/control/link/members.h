// control/link/members.h - how many members an aggregate has, so that a list of its fields notices
// when one is added: static_assert(members<Gains>() == 3).
#pragma once

#include <cstddef>

namespace sinew::link {

// Stands for a member of any type.
struct AnyMember {
  template <class T>
  operator T() const;  // never defined: only asked whether it would do
};

template <class T, class... Before>
consteval std::size_t members() {
  if constexpr (requires { T{Before{}..., AnyMember{}}; })
    return members<T, Before..., AnyMember>();
  else
    return sizeof...(Before);
}

}  // namespace sinew::link
