#pragma once

/// Before a function with a loop that GCC turns into SIMD: compiles it for several processors, of
/// which the program picks its own when it starts. Sanitizers run before that choice can be made,
/// so they do without.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define WEFT_CPU_VERSIONS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WEFT_CPU_VERSIONS
#endif
