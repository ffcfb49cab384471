// libFuzzer's entry; SINEW_FUZZ is the function that gets the inputs.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/law.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sinew::fuzz::SINEW_FUZZ({reinterpret_cast<const char*>(data), size});
  return 0;
}
