// card/walk.h - the program with which a graphics card runs machines (run/card/kernel.cu), as it
// was compiled when Sinew was built.
#pragma once

#include <string_view>

namespace sinew::card {

// Returns its text in PTX, for card::Program; the kernel is "walk". Empty if Sinew was built
// without a compiler for cards (cmake/card.cmake).
std::string_view walk_ptx();

}  // namespace sinew::card
