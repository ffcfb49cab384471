// run/card/walk_on_processor.cpp - the kernel for one thread, compiled for the processor: a
// substitute for a card's driver calls it (tests/graphics_card/fake_driver.cpp).
#include "sinew/run/card/kernel.h"

// `parameters` are those of the kernel.
extern "C" void sinew_walk_on_processor(void** parameters, long thread) {
  using namespace sinew::run;
  run_thread(*static_cast<Walk**>(parameters[0]), *static_cast<const Launch*>(parameters[1]),
             thread, [](bool x) { return x; });
}
