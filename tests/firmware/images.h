// tests/firmware/images.h - the firmware's images, where they could be built.
#pragma once

#include <string>

#include "tests/places.h"

namespace sinew::firmware {

inline std::string image(const std::string& name) {
  return test::build_dir() + "/tests/firmware/images/firmware/" + name + ".elf";
}

inline bool missing() { return SINEW_HAS_FIRMWARE == 0; }
inline constexpr const char* what_is_missing =
    "not installed: qemu-system-arm or arm-none-eabi-g++ (Debian: gcc-arm-none-eabi, "
    "libstdc++-arm-none-eabi-newlib)";

}  // namespace sinew::firmware
