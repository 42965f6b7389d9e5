// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Memory for the large arrays of a query.
#pragma once

#include <memory>

#include <tbb/scalable_allocator.h>

namespace fcl_prob::detail {

/// malloc gives large arrays back to the system after each query, which then hands out new pages to
/// the next one, all of them cleared: a quarter of an estimate between dense meshes. oneTBB's
/// allocator keeps what was used lately.
#ifdef FCL_PROB_SANITIZED  // a sanitizer only watches over what malloc gave
template <typename T>
using KeptMemory = std::allocator<T>;
#else
template <typename T>
using KeptMemory = tbb::scalable_allocator<T>;
#endif

}  // namespace fcl_prob::detail
