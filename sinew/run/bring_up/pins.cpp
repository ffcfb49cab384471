#include "sinew/run/bring_up/pins.h"

namespace sinew::run {
namespace {

// Implemented in firmware/boards/<board>/board.cpp; docs/reference/firmware.md has them as a table.
constexpr std::string_view stm32f405_inputs[] = {"PA0", "PA1", "PA2", "PA3", "PA4", "PA5", "PA6",
                                                 "PA7", "PC0", "PC1", "PC2", "PC3", "PC4", "PC5"};
constexpr std::string_view stm32f405_outputs[] = {"PB4",  "PB5",  "PB6",  "PB7",  "PB8",  "PB9",
                                                  "PB10", "PB11", "PB12", "PB13", "PB14", "PB15",
                                                  "PC6",  "PC7",  "PC8",  "PC9"};
constexpr std::string_view teensy41_inputs[] = {"pin 14", "pin 15", "pin 16", "pin 17", "pin 18",
                                                "pin 19", "pin 20", "pin 21", "pin 22", "pin 23",
                                                "pin 24", "pin 25", "pin 40", "pin 41"};
constexpr std::string_view teensy41_outputs[] = {
    "pin 6",  "pin 7",  "pin 8",  "pin 9",  "pin 10", "pin 11", "pin 12", "pin 32",
    "pin 34", "pin 35", "pin 36", "pin 37", "pin 2",  "pin 3",  "pin 4",  "pin 5"};

constexpr Pins pins[] = {
    {"stm32f405", stm32f405_inputs, stm32f405_outputs, "PC12", "PA9 out, PA10 in"},
    {"teensy41", teensy41_inputs, teensy41_outputs, "pin 33", "pin 1 out, pin 0 in"},
};

}  // namespace

std::span<const Pins> all_pins() { return pins; }

const Pins* pins_of(std::string_view board) {
  for (const Pins& p : pins)
    if (p.board == board) return &p;
  return nullptr;
}

std::string in_brackets(std::span<const std::string_view> of, std::size_t number) {
  return number < of.size() ? " (" + std::string(of[number]) + ")" : "";
}

}  // namespace sinew::run
