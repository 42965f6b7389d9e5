// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Wolfe's algorithm for the point of a convex hull next to the origin. Nothing is proved by it: it
// finds directions that are then checked.
#pragma once

#include <functional>

#include "ball.h"

namespace verify {

/// `support(d)` is the point of the hull that reaches least along d. Stops with true where
/// `accept(d)` is true of a direction on the way; else `direction` is the last one.
bool nearest_to_origin(const std::function<Vec(const Vec&)>& support, Vec& direction,
                       const std::function<bool(const Vec&)>& accept);

}  // namespace verify
