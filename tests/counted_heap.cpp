#include "tests/counted_heap.h"

#include <cstdlib>
#include <new>

namespace sinew::test {

thread_local bool counting = false;
thread_local int allocations = 0;
thread_local std::size_t bytes = 0;

namespace {

void count_allocation(std::size_t size) {
  allocations += counting ? 1 : 0;
  bytes += counting ? size : 0;
}

}  // namespace
}  // namespace sinew::test

using sinew::test::count_allocation;

// Not inlined: otherwise GCC sees malloc together with delete and warns.
[[gnu::noinline]] void* operator new(std::size_t size) {
  count_allocation(size);
  if (void* p = std::malloc(size ? size : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  count_allocation(size);
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t align) {
  count_allocation(size);
  const auto a = static_cast<std::size_t>(align);
  if (void* p = std::aligned_alloc(a, (size + a) / a * a)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
