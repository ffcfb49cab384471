// firmware/emulated.cpp - start-up of images for QEMU's Cortex-M4F board that use no interrupts.
#include "firmware/semihosting.h"
#include "firmware/start.h"

extern "C" {
[[noreturn]] void reset() { sinew::firmware::start_application(); }
void fault() { sinew::firmware::fail("fault\n"); }
}

namespace sinew::firmware {
[[gnu::section(".vectors"), gnu::used]] constinit const auto table = vectors<1>(reset, fault);
}
