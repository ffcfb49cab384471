// tests/counted_heap.h - counts the heap allocations of one thread. A program that uses it has its
// own operator new (counted_heap.cpp).
#pragma once

#include <cstddef>

namespace sinew::test {

extern thread_local bool counting;      // set around code that must not allocate
extern thread_local int allocations;    // made while counting
extern thread_local std::size_t bytes;  // their size

}  // namespace sinew::test
