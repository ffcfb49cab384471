// tests/places.h - where the sources and the built programs are. The paths are in one generated
// source, so that the objects of all other tests are the same in every checkout and a compiler
// cache finds them.
#pragma once

#include <string>

namespace sinew::test {

std::string source_dir();  // the repository
std::string build_dir();   // the folder of the build
std::string program();     // the built program `sinew`

}  // namespace sinew::test
