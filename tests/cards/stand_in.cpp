// A substitute for a card and for the clock: preloaded, it answers in libcomedi's and the C
// library's place. Time passes only while the program sleeps, so that a busy computer is never
// late, and delays are exactly those that the test sets.
//
// The environment describes the card and its behaviour:
//
//   CARD_INPUTS, CARD_OUTPUTS, CARD_TOP, CARD_LOW, CARD_HIGH   its properties
//   CARD_BUSY        1: another program has its outputs
//   CARD_STUCK       this line cannot be made an output
//   CARD_COUNTS      "25:1895,26:1175": the counts of a channel; else the middle
//   CARD_READ_ERROR  from this conversion on they fail with EIO
//   CARD_SLOW        so many conversions from the 100th take 250 us
//   CARD_WRITE_ERROR this write fails with EIO, and all that follow
//   CARD_SLEEP       "700:50000000": the wake-up after so many sleeps is late  [ns]
//   CARD_SIGNAL      "700:15": at that sleep and the four after it this signal comes
//   CARD_LOG         file of what is written: time [ns], mask, bits
//   CARD_HEAP        a file that is written where the loop's thread takes memory
#include <comedilib.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<std::int64_t> now{1'000'000'000};  // [ns]
std::atomic<long> sleeps{0}, conversions{0}, writes{0};
thread_local int error = 0;
thread_local long slept = 0;    // by this thread
thread_local bool own = false;  // allocations of the stand-in are not the program's
comedi_range range{};
int the_card = 0;

double number(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : otherwise;
}

// The second number of "first:second" where the first is this one, else 0.
long at(const char* name, long first) {
  const char* text = std::getenv(name);
  char* end = nullptr;
  if (!text || std::strtol(text, &end, 10) != first || *end != ':') return 0;
  return std::strtol(end + 1, nullptr, 10);
}

lsampl_t count_of(unsigned channel) {
  const char* text = std::getenv("CARD_COUNTS");
  while (text && *text) {
    char* end = nullptr;
    const unsigned long its = std::strtoul(text, &end, 10);
    const unsigned long count = std::strtoul(end + 1, &end, 10);
    if (its == channel) return static_cast<lsampl_t>(count);
    text = *end == ',' ? end + 1 : nullptr;
  }
  return static_cast<lsampl_t>(number("CARD_TOP", 4095) / 2);
}

void keep(unsigned mask, unsigned bits) {
  own = true;
  const char* name = std::getenv("CARD_LOG");
  std::FILE* file = name ? std::fopen(name, "a") : nullptr;
  if (file) {
    std::fprintf(file, "%lld %u %u\n", static_cast<long long>(now.load()), mask, bits);
    std::fclose(file);
  }
  own = false;
}

// The loop is running: the sleeps of the measurement and a few of the run's are over.
bool looping() { return slept > 10'100 && slept < 12'000 && !own; }

void tell_of_heap() {
  own = true;
  const char* name = std::getenv("CARD_HEAP");
  if (std::FILE* file = name ? std::fopen(name, "a") : nullptr) std::fclose(file);
  own = false;
}

int fail_with(int code) {
  error = code;
  return -1;
}

bool is_slow(long conversion) {
  return conversion >= 100 && conversion < 100 + static_cast<long>(number("CARD_SLOW", 0));
}

}  // namespace

extern "C" {

#ifndef SINEW_SANITIZED  // a sanitizer has a malloc of its own
void* __libc_malloc(std::size_t);

void* malloc(std::size_t size) {
  if (looping()) tell_of_heap();
  return __libc_malloc(size);
}
#endif

int clock_gettime(clockid_t, timespec* out) noexcept {
  out->tv_sec = now / 1'000'000'000;
  out->tv_nsec = now % 1'000'000'000;
  return 0;
}

int clock_nanosleep(clockid_t, int, const timespec* until, timespec*) {
  const std::int64_t due = until->tv_sec * std::int64_t{1'000'000'000} + until->tv_nsec;
  const long n = ++sleeps;
  ++slept;
  if (due > now) now = due;
  now += at("CARD_SLEEP", n);
  for (long k = 0; k < 5; ++k)
    if (const long s = at("CARD_SIGNAL", n - k)) kill(getpid(), static_cast<int>(s));
  return 0;
}

comedi_t* comedi_open(const char* device) {
  if (std::strcmp(device, "/dev/comedi0") == 0) return reinterpret_cast<comedi_t*>(&the_card);
  error = std::strcmp(device, "/dev/comedi1") == 0 ? EACCES : ENOENT;
  return nullptr;
}

int comedi_close(comedi_t*) { return 0; }
int comedi_errno() { return error; }
const char* comedi_strerror(int code) { return std::strerror(code); }
const char* comedi_get_board_name(comedi_t*) { return "stand-in"; }
int comedi_get_n_subdevices(comedi_t*) { return 3; }

// The second channel is a counter, which is not used.
int comedi_get_subdevice_type(comedi_t*, unsigned subdevice) {
  if (subdevice == 0) return number("CARD_INPUTS", 32) > 0 ? COMEDI_SUBD_AI : COMEDI_SUBD_UNUSED;
  if (subdevice == 1) return COMEDI_SUBD_COUNTER;
  return number("CARD_OUTPUTS", 16) > 0 ? COMEDI_SUBD_DIO : COMEDI_SUBD_UNUSED;
}

int comedi_find_subdevice_by_type(comedi_t* card, int type, unsigned from) {
  for (unsigned s = from; s < 3; ++s)
    if (comedi_get_subdevice_type(card, s) == type) return static_cast<int>(s);
  return -1;
}

int comedi_get_n_channels(comedi_t*, unsigned subdevice) {
  return static_cast<int>(subdevice == 0 ? number("CARD_INPUTS", 32) : number("CARD_OUTPUTS", 16));
}

lsampl_t comedi_get_maxdata(comedi_t*, unsigned, unsigned) {
  return static_cast<lsampl_t>(number("CARD_TOP", 4095));
}

int comedi_get_n_ranges(comedi_t*, unsigned, unsigned) { return 1; }

comedi_range* comedi_get_range(comedi_t*, unsigned, unsigned, unsigned) {
  range = {number("CARD_LOW", 0), number("CARD_HIGH", 5), UNIT_volt};
  return &range;
}

int comedi_lock(comedi_t*, unsigned) { return number("CARD_BUSY", 0) > 0 ? fail_with(EBUSY) : 0; }

int comedi_dio_config(comedi_t*, unsigned, unsigned channel, unsigned) {
  return number("CARD_STUCK", -1) == channel ? fail_with(EINVAL) : 0;
}

int comedi_data_read(comedi_t*, unsigned, unsigned channel, unsigned, unsigned, lsampl_t* data) {
  const long n = ++conversions;
  if (is_slow(n)) now += 250'000;
  const double from = number("CARD_READ_ERROR", 0);
  if (from > 0 && static_cast<double>(n) >= from) return fail_with(EIO);
  *data = count_of(channel);
  return 1;
}

int comedi_dio_bitfield2(comedi_t*, unsigned, unsigned mask, unsigned* bits, unsigned) {
  const double from = number("CARD_WRITE_ERROR", 0);
  if (from > 0 && static_cast<double>(++writes) >= from) return fail_with(EIO);
  keep(mask, *bits);
  return 0;
}

}  // extern "C"
