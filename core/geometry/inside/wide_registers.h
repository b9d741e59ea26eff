// Marks functions that are compiled a second time for processors with wide registers.
#pragma once

/// Which of the two is called follows from the processor, when the program starts. Both give the same bits: every sum keeps its
/// order, and no product is fused with a sum. The golden traces hold this: builds of clang and with sanitizers, which start later
/// than the choice, have only the plain functions. All that a marked function calls is compiled into it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define BL_WIDE_REGISTERS __attribute__((target_clones("avx2", "default"), flatten))
#else
#define BL_WIDE_REGISTERS
#endif
