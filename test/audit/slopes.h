// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gradients against how P changes when the mean does.
#pragma once

#include <optional>
#include <string>

#include "fcl_prob/probability_result.h"
#include "scene.h"

namespace fcl_prob_audit {

/// What is wrong, if P at means a step ahead and behind, by two steps, is such that the slope can
/// not be within the gradient's bounds. Allows for curvature and kinks as far as the differences
/// show them, so it finds only what is wrong by more.
std::optional<std::string> slopesOutside(const Scene& scene,
                                         const fcl_prob::ProbabilityResult& result);

}  // namespace fcl_prob_audit
