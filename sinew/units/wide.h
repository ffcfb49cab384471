// units/wide.h - SINEW_WIDE: compiles a function over lanes of four doubles twice, with and without
// AVX2; the operations are the same, so the bits are, too. Not with sanitizers, which start before
// the loader can choose, nor with Clang 14, whose clones have names that other files do not find.
#pragma once

#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SINEW_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SINEW_WIDE
#endif
