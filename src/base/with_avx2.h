// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Functions over plain arrays that are compiled once more for AVX2.
#pragma once

/// Before a function: the program chooses when it is loaded, and both have the same results, four
/// numbers at a time by the vector extension of gcc and clang. No Eigen type may be in it, whose
/// alignment (and so libfcl's ABI) changes with the instruction set.
/// The thread sanitizer is not ready yet where the choice is made: it gets one of them.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define FCL_PROB_THREAD_SANITIZER
#endif
#elif defined(__SANITIZE_THREAD__)
#define FCL_PROB_THREAD_SANITIZER
#endif

#if defined(__x86_64__) && !defined(FCL_PROB_THREAD_SANITIZER)
#define FCL_PROB_WITH_AVX2 __attribute__((target_clones("avx2", "default")))
#else
#define FCL_PROB_WITH_AVX2
#endif
