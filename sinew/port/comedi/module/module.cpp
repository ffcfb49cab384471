// Module that wraps libcomedi.
#include "sinew/port/comedi/module/card.h"

#include <comedilib.h>

#include <cstring>

namespace {

comedi_t* of(void* card) { return static_cast<comedi_t*>(card); }

void* open_card(const char* device) { return comedi_open(device); }

void close_card(void* card) { comedi_close(of(card)); }

const char* error_text() { return comedi_strerror(comedi_errno()); }

// Finds the narrowest range in volts that covers 0 .. volts; range -1 and the widest if none does.
void choose_range(comedi_t* card, double volts, SinewCardFacts& out) {
  const auto input = static_cast<unsigned>(out.input);
  const int ranges = comedi_get_n_ranges(card, input, 0);
  double widest = 0;
  for (int i = 0; i < ranges; ++i) {
    const comedi_range* r = comedi_get_range(card, input, 0, static_cast<unsigned>(i));
    if (!r || r->unit != UNIT_volt) continue;
    const bool covers = r->min <= 0 && r->max >= volts * (1 - 1e-9);
    const double span = r->max - r->min;
    const bool better =
        covers ? out.range < 0 || span < out.high - out.low : out.range < 0 && span > widest;
    if (!better) continue;
    if (covers) out.range = i;
    widest = span;
    out.low = r->min;
    out.high = r->max;
  }
}

void find_output(comedi_t* card, int wanted, SinewCardFacts& out) {
  const int subdevices = comedi_get_n_subdevices(card);
  for (int i = 0; i < subdevices && out.outputs < wanted; ++i) {
    const int type = comedi_get_subdevice_type(card, static_cast<unsigned>(i));
    if (type != COMEDI_SUBD_DIO && type != COMEDI_SUBD_DO) continue;
    const int channels = comedi_get_n_channels(card, static_cast<unsigned>(i));
    if (channels <= out.outputs) continue;
    out.output = i;
    out.outputs = channels;
  }
}

bool find_subdevices(void* card, double volts, int outputs, SinewCardFacts* out) {
  *out = {};
  out->range = out->output = -1;
  const char* name = comedi_get_board_name(of(card));
  if (!name) return false;
  std::strncpy(out->board, name, sizeof out->board - 1);
  out->input = comedi_find_subdevice_by_type(of(card), COMEDI_SUBD_AI, 0);
  if (out->input >= 0) {
    const auto input = static_cast<unsigned>(out->input);
    out->inputs = comedi_get_n_channels(of(card), input);
    out->top = comedi_get_maxdata(of(card), input, 0);
    choose_range(of(card), volts, *out);
  }
  find_output(of(card), outputs, *out);
  return true;
}

bool own(void* card, int subdevice) {
  return comedi_lock(of(card), static_cast<unsigned>(subdevice)) >= 0;
}

// A subdevice that has outputs only has no direction to configure.
bool make_output(void* card, int subdevice, int channel) {
  const auto s = static_cast<unsigned>(subdevice);
  if (comedi_get_subdevice_type(of(card), s) == COMEDI_SUBD_DO) return true;
  return comedi_dio_config(of(card), s, static_cast<unsigned>(channel), COMEDI_OUTPUT) >= 0;
}

bool convert(void* card, int subdevice, int channel, int range, std::uint32_t* count) {
  lsampl_t data = 0;
  const int n =
      comedi_data_read(of(card), static_cast<unsigned>(subdevice), static_cast<unsigned>(channel),
                       static_cast<unsigned>(range), AREF_GROUND, &data);
  *count = data;
  return n >= 0;
}

bool write(void* card, int subdevice, std::uint32_t mask, std::uint32_t bits) {
  unsigned value = bits;
  return comedi_dio_bitfield2(of(card), static_cast<unsigned>(subdevice), mask, &value, 0) >= 0;
}

constexpr SinewCard functions{open_card,   close_card, find_subdevices, own,
                              make_output, convert,    write,           error_text};

}  // namespace

extern "C" const SinewCard* sinew_card_1() { return &functions; }
