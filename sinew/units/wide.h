// units/wide.h - SINEW_WIDE: a function over lanes of four doubles that is compiled for machines
// that have them beside those that have not; the same operations, so the same bits. The sanitizers
// start before the loader could choose, and what Clang 14 makes of it has a name that no other file
// finds.
#pragma once

#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SINEW_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SINEW_WIDE
#endif
