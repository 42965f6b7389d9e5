// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

namespace fcl_prob::detail {

/// A node of A's tree and one of B's.
struct NodePair {
  int a;
  int b;
};

}  // namespace fcl_prob::detail
