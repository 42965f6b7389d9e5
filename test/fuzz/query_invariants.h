// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What has to hold of every answer, and between answers of the same question.
#pragma once

#include <optional>

#include "fcl_prob/probability_result.h"
#include "random_scene.h"

namespace fcl_prob_fuzz {

/// Nothing if the query was refused with an exception that the library announces; any other
/// exception passes through.
std::optional<fcl_prob::ProbabilityResult> answerOf(const PairScene& scene);

/// The scene in words, to rebuild it in a test.
std::string textOf(const PairScene& scene);

/// The same question with the objects in the other order.
PairScene swapped(const PairScene& scene);

/// Ends the program unless the bounds are probabilities in order and all numbers are finite.
void requireSound(const fcl_prob::ProbabilityResult& result);

/// Ends the program unless there is a probability within both answers' bounds.
void requireCompatible(const fcl_prob::ProbabilityResult& x, const fcl_prob::ProbabilityResult& y,
                       const std::string& difference);

/// Ends the program unless the answers are equal to the last bit.
void requireSame(const fcl_prob::ProbabilityResult& x, const fcl_prob::ProbabilityResult& y);

/// Draws a few displacements, asks fcl::collide, and ends the program if their number of collisions
/// has a probability below 1e-13 under any P within the bounds. Displacements that are within
/// rounding of a touch count for neither side. Says whether it could be tried: only where
/// fcl::collide is to be relied on.
bool requireSamplesAgree(const PairScene& scene, const fcl_prob::ProbabilityResult& result,
                         std::uint64_t seed);

}  // namespace fcl_prob_fuzz
