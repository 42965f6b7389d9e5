// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Fitting the mixture of an importance density to the hits seen so far.
#pragma once

#include <vector>

#include "sampling/importance_density.h"

namespace fcl_prob::detail {

struct WeightedPoint {
  Eigen::Vector3d point;
  double weight;
};

/// A mixture of at most `most` components that follows the weighted points (expectation
/// maximisation; cross-entropy method of Kurtz & Song 2013), somewhat wider than they are. Empty if
/// there are too few points to tell a shape. \param rank  1 to 3: the number of coordinates that
/// move
std::vector<MixtureComponent> fitMixture(const std::vector<WeightedPoint>& points, int rank,
                                         int most);

}  // namespace fcl_prob::detail
