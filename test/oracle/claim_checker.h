// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Every claim that the partition settles mass by, against the oracle.
//
// What is claimed of a set of whitened points holds for all of them
// (src/cells/claim_observer.h); some are tried, most of them at corners, on edges and faces of
// cells and on planes, as little inside as doubles allow. A point y stands
// for the displacement that has it by law (whitened_frame.h), so that what is rounded in whitening
// counts as the partition's.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "fcl_prob/collision_probability.h"
#include "oracle/oracle.h"

namespace oracle {

struct ClaimBudget {
  std::size_t claims = 2000;  ///< most that are checked; each method of proof gets its share
  int points = 3;             ///< displacements tried for each
  std::size_t kept = 5;       ///< violations that are told in full
};

/// A displacement at which what was claimed does not hold.
struct Violation {
  std::string method;  ///< of the proof
  bool claimed_contact = false;
  Eigen::Vector3d y;             ///< whitened
  Eigen::Vector3d displacement;  ///< rounded, metres
  std::string text;              ///< all that is needed to look at it again, in hexadecimal
};

struct ClaimCount {
  std::size_t made = 0;     ///< claims
  std::size_t checked = 0;  ///< claims of which at least one point was tried
  std::size_t points = 0;
  std::size_t undecided = 0;  ///< points of which the oracle could not tell
  std::size_t excused = 0;    ///< points in slivers that are counted in the upper bound
  std::size_t violated = 0;   ///< points
};

struct ClaimReport {
  std::map<std::string, ClaimCount> by_method;
  std::vector<Violation> violations;

  ClaimCount total() const;
  ClaimReport& operator+=(const ClaimReport& other);

  /// A line for each method.
  std::string table() const;
};

/// Runs `query`, which must ask about `scene` and work in this thread, and checks what it claims.
ClaimReport checkClaims(const Scene& scene, const std::function<void()>& query,
                        const ClaimBudget& budget, std::uint64_t seed);

/// The same for a pair, by fcl_prob::collisionProbability; the request's method should be
/// `interval` or `estimate`: others claim nothing of cells. \param result  null, or what the query
/// answers
ClaimReport checkClaims(const Placed& a, const Placed& b,
                        const fcl_prob::GaussianDisplacement& displacement,
                        const fcl_prob::ProbabilityRequest& request, const ClaimBudget& budget,
                        std::uint64_t seed, fcl_prob::ProbabilityResult* result = nullptr);

}  // namespace oracle
