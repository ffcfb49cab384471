// RM0090: chapters 8 (GPIO), 13 (ADC), 18 (TIM2 to TIM5).
#include "tests/firmware/boards/wiring.h"

namespace sinew::firmware {
namespace {

constexpr std::uintptr_t gpio_b = 0x40020400, gpio_c = 0x40020800, adc_1 = 0x40012000,
                         tim_5 = 0x40000C00;
constexpr std::uintptr_t moder = 0x00, odr = 0x14, bsrr = 0x18, sqr_3 = 0x34, cnt = 0x24,
                         ccr_1 = 0x34;

std::uint32_t at(std::uintptr_t address) { return cortex_m::registers().value[address]; }

struct Pin {
  std::uintptr_t port;
  std::uint32_t bit;
};
Pin pin(std::uint32_t output) {
  if (output < 12) return {gpio_b, output + 4};
  return {gpio_c, output < 16 ? output - 6 : 12};
}

std::string name_of(std::uint32_t output) {
  const Pin p = pin(output);
  return (p.port == gpio_b ? "PB" : "PC") + std::to_string(p.bit);
}

bool drives(std::uint32_t output) {
  const Pin p = pin(output);
  return (at(p.port + moder) >> 2 * p.bit & 3u) == 1;
}
bool has_current(std::uint32_t output) {
  const Pin p = pin(output);
  return (at(p.port + odr) >> p.bit & 1u) != low_gives_current;
}
std::uint32_t converter_input() { return at(adc_1 + sqr_3); }
std::uint32_t input_of(std::uint32_t input) { return input < 8 ? input : input + 2; }

void act(std::uintptr_t address, std::uint32_t value) {
  for (const std::uintptr_t port : {gpio_b, gpio_c})
    if (address == port + bsrr)
      cortex_m::registers().value[port + odr] =
          (at(port + odr) & ~(value >> 16)) | (value & 0xFFFFu);
}
void power_on() {
  cortex_m::registers().value[gpio_b + odr] = cortex_m::registers().value[gpio_c + odr] =
      low_gives_current ? 0 : 0xFFFF;
}

}  // namespace

const Wiring wiring{
    "stm32f405",   name_of, 16, 14, drives, has_current, converter_input, input_of, tim_5 + cnt,
    tim_5 + ccr_1, 84,      50, 37, 28,     act,         power_on};

}  // namespace sinew::firmware
