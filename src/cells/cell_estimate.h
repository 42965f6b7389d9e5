// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the boxes of a partition tell besides their interval: an estimate, and the gradient of P.
#pragma once

#include "cells/cell_sampling.h"
#include "cells/partition_engine.h"

namespace fcl_prob::detail {

/// Certified bounds on ∂P/∂mean = Wᵀ E[y 1_V] (the log density's derivative). Only with a density:
/// where A does not move, P still changes with the mean, by what the boundary of the section
/// sweeps, which no moment of the section tells.
void fillGradient(const Whitening& whitening, const MomentBounds& moment,
                  ProbabilityResult& result);

/// Samples what the engine leaves open. Where that varies more than expected, more samples are
/// drawn or more cells are divided: until the standard error is what was asked for, or a limit is
/// reached.
SampledMass sampleOpenCells(PartitionEngine& engine, CellSampler& sampler,
                            const ProbabilityStatistics& statistics, ProbabilityStatus& status);

/// \param with_gradient  its estimate, too
void fillEstimate(const Whitening& whitening, const PartitionEngine& engine,
                  const SampledMass& sampled, bool with_gradient, ProbabilityResult& result);

}  // namespace fcl_prob::detail
