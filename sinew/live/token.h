// live/token.h - a word that nobody guesses, as part of an address.
#pragma once

#include <string>
#include <string_view>

namespace sinew::live {

// 128 random bits of the operating system as 32 hexadecimal digits. Throws std::runtime_error where
// it has none.
std::string random_token();

// Whether the two are the same; how long that takes tells their lengths and nothing else.
bool same_token(std::string_view a, std::string_view b);

}  // namespace sinew::live
