// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include <libqhullcpp/Qhull.h>

namespace fcl_prob::detail {

/// One run of Qhull that keeps its warnings to itself: orgQhull::Qhull prints what nobody has read
/// to std::cerr as it goes away, and a library does not write there. Its errors are exceptions.
class QuietQhull : public orgQhull::Qhull {
 public:
  QuietQhull() = default;
  QuietQhull(const QuietQhull&) = delete;
  QuietQhull& operator=(const QuietQhull&) = delete;
  ~QuietQhull() { clearQhullMessage(); }
};

}  // namespace fcl_prob::detail
