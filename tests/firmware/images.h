// tests/firmware/images.h - the firmware's images, where they could be built.
#pragma once

#include <string>

namespace sinew::firmware {

inline std::string image(const std::string& name) {
  return SINEW_FIRMWARE_IMAGES "/" + name + ".elf";
}

inline bool missing() { return std::string(SINEW_FIRMWARE_IMAGES).empty(); }
inline constexpr const char* what_is_missing =
    "not installed: qemu-system-arm or arm-none-eabi-g++ (Debian: gcc-arm-none-eabi, "
    "libstdc++-arm-none-eabi-newlib)";

}  // namespace sinew::firmware
