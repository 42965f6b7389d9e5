// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The yardstick: a bare loop of fcl::collide.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cli/prepared_scene.h"

namespace fcl_prob::cli {

struct FclLoop {
  std::size_t samples = 0;
  std::size_t hits = 0;
  double time_ms = 0.0;

  double estimate() const { return static_cast<double>(hits) / static_cast<double>(samples); }
};

/// Counts collisions over `samples` displacements of A, drawn before the clock starts, by calling
/// fcl::collide on OBBRSS trees on one thread with nothing around it. The quickest of three loops.
FclLoop timeFclLoop(const PreparedScene& scene, std::size_t samples, std::uint64_t seed);

}  // namespace fcl_prob::cli
