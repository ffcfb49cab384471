// firmware/memory.cpp - the four functions that a compiler may call even without a C library, to
// copy and clear structs. They are compiled so that their loops do not become calls of themselves,
// and copy whole words where both sides are aligned.
#include <cstddef>
#include <cstdint>

extern "C" {

using Word [[gnu::may_alias]] = std::uint32_t;

void* memcpy(void* to, const void* from, std::size_t n) {
  auto* d = static_cast<unsigned char*>(to);
  auto* s = static_cast<const unsigned char*>(from);
  if (((reinterpret_cast<std::uintptr_t>(d) | reinterpret_cast<std::uintptr_t>(s)) & 3u) == 0) {
    for (; n >= 16; n -= 16, d += 16, s += 16) {
      auto* x = reinterpret_cast<Word*>(d);
      auto* y = reinterpret_cast<const Word*>(s);
      const Word a = y[0], b = y[1], c = y[2], e = y[3];
      x[0] = a, x[1] = b, x[2] = c, x[3] = e;
    }
    for (; n >= 4; n -= 4, d += 4, s += 4)
      *reinterpret_cast<Word*>(d) = *reinterpret_cast<const Word*>(s);
  }
  for (std::size_t i = 0; i < n; ++i) d[i] = s[i];
  return to;
}

void* memmove(void* to, const void* from, std::size_t n) {
  auto* d = static_cast<unsigned char*>(to);
  auto* s = static_cast<const unsigned char*>(from);
  if (d < s) return memcpy(to, from, n);
  while (n-- > 0) d[n] = s[n];
  return to;
}

void* memset(void* to, int value, std::size_t n) {
  auto* d = static_cast<unsigned char*>(to);
  const Word byte = static_cast<unsigned char>(value), word = byte * 0x01010101u;
  if ((reinterpret_cast<std::uintptr_t>(d) & 3u) == 0) {
    for (; n >= 32; n -= 32, d += 32) {
      auto* x = reinterpret_cast<Word*>(d);
      x[0] = word, x[1] = word, x[2] = word, x[3] = word;
      x[4] = word, x[5] = word, x[6] = word, x[7] = word;
    }
    for (; n >= 4; n -= 4, d += 4) *reinterpret_cast<Word*>(d) = word;
  }
  for (std::size_t i = 0; i < n; ++i) d[i] = static_cast<unsigned char>(byte);
  return to;
}

int memcmp(const void* a, const void* b, std::size_t n) {
  auto* x = static_cast<const unsigned char*>(a);
  auto* y = static_cast<const unsigned char*>(b);
  for (std::size_t i = 0; i < n; ++i)
    if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
  return 0;
}

}  // extern "C"
