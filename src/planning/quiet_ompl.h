// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// OMPL without what it prints to standard output.
#pragma once

namespace fcl_prob::detail {

/// While any of these lives OMPL's log, which belongs to the whole process, goes nowhere; then to
/// where it went before.
class QuietOmpl {
 public:
  QuietOmpl();
  ~QuietOmpl();
  QuietOmpl(const QuietOmpl&) = delete;
  QuietOmpl& operator=(const QuietOmpl&) = delete;
};

}  // namespace fcl_prob::detail
