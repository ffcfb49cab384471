// i.MX RT1060 reference manual: chapters 12 (GPIO), 52 (GPT), 66 (ADC); PJRC's card of the pins.
#include <array>

#include "tests/firmware/boards/wiring.h"

namespace sinew::firmware {
namespace {

constexpr std::uintptr_t gpio_7 = 0x42004000, gpio_9 = 0x4200C000, adc_1 = 0x400C4000,
                         gpt_1 = 0x401EC000;
constexpr std::uintptr_t dr = 0x00, gdir = 0x04, hc_0 = 0x00, ocr_1 = 0x10, cnt = 0x24;

std::uint32_t at(std::uintptr_t address) { return cortex_m::registers().value[address]; }

struct Pin {
  std::uintptr_t port;
  std::uint32_t bit;
  int number;  // printed on the board
};
// Outputs 0 … 15 and the supply.
constexpr std::array<Pin, 17> pins{{
    {gpio_7, 10, 6},   // B0_10
    {gpio_7, 17, 7},   // B1_01
    {gpio_7, 16, 8},   // B1_00
    {gpio_7, 11, 9},   // B0_11
    {gpio_7, 0, 10},   // B0_00
    {gpio_7, 2, 11},   // B0_02
    {gpio_7, 1, 12},   // B0_01
    {gpio_7, 12, 32},  // B0_12
    {gpio_7, 29, 34},  // B1_13
    {gpio_7, 28, 35},  // B1_12
    {gpio_7, 18, 36},  // B1_02
    {gpio_7, 19, 37},  // B1_03
    {gpio_9, 4, 2},    // EMC_04
    {gpio_9, 5, 3},    // EMC_05
    {gpio_9, 6, 4},    // EMC_06
    {gpio_9, 8, 5},    // EMC_08
    {gpio_9, 7, 33},   // EMC_07
}};
// ADC1's inputs at pins 14 … 25, 40, 41.
constexpr std::array<std::uint32_t, 14> inputs{7, 8, 12, 11, 6, 5, 15, 0, 13, 14, 1, 2, 9, 10};

std::string name_of(std::uint32_t output) { return "pin " + std::to_string(pins[output].number); }

bool drives(std::uint32_t output) { return at(pins[output].port + gdir) >> pins[output].bit & 1u; }
bool has_current(std::uint32_t output) {
  return (at(pins[output].port + dr) >> pins[output].bit & 1u) != low_gives_current;
}
std::uint32_t converter_input() { return at(adc_1 + hc_0); }
std::uint32_t input_of(std::uint32_t input) { return inputs[input]; }

void act(std::uintptr_t, std::uint32_t) {}
void power_on() {
  cortex_m::registers().value[gpio_7 + dr] = cortex_m::registers().value[gpio_9 + dr] =
      low_gives_current ? 0 : ~0u;
}

}  // namespace

const Wiring wiring{
    "teensy41",    name_of, 16,  14, drives, has_current, converter_input, input_of, gpt_1 + cnt,
    gpt_1 + ocr_1, 24,      100, 25, 122,    act,         power_on};

}  // namespace sinew::firmware
