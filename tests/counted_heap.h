// tests/counted_heap.h - counts what one thread takes from the heap. A program that uses it has its
// own operator new (counted_heap.cpp).
#pragma once

#include <cstddef>

namespace sinew::test {

extern thread_local bool counting;      // set it around what must take nothing
extern thread_local int allocations;    // taken while counting
extern thread_local std::size_t bytes;  // their size

}  // namespace sinew::test
