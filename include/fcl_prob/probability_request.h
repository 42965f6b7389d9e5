// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is asked of a query.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/band.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob {

/// How the probability is computed.
enum class ProbabilityMethod {
  automatic,        ///< the best that the scene allows; ProbabilityResult::plan says which
  interval,         ///< certified interval by a disjoint partition of the displacement space
  estimate,         ///< the partition's estimate with its standard error; interval also given
  exact,            ///< two convex shapes only: exact mass of their C-obstacle
  convex_pcd,       ///< least upper bound of two convex shapes (or of the root volumes of meshes)
  general_pcd,      ///< upper bound by the paper's Algorithm 2 over the bounding volume trees
  general_pcd_min,  ///< the same with min(parent, sum of the children) at every node
  monte_carlo,      ///< displaced fcl::collide: a confidence interval, nothing certified
  rare_event        ///< importance sampling around the nearest contact: a confidence interval
};

/// What counts as a collision.
enum class ContactMeaning {
  fcl,    ///< what fcl::collide answers: meshes are surfaces, primitives and Convex are solids
  solid,  ///< closed meshes are solids too: one inside the other collides

  /// No contact, but A wholly within B, surfaces apart: of pairs, by methods automatic, interval
  /// and estimate. B is a closed mesh, a Box or a Convex (its faces), A a closed mesh or a convex
  /// shape, and neither is in several pieces that do not hang together.
  contained
};

/// How far a running query has come; `interval` is valid at every moment (certified for the
/// partition, a confidence interval for Monte Carlo).
struct ProbabilityProgress {
  Bounds interval;
  double fraction = 0.0;  ///< of the work that the limits allow, 0 to 1
  double seconds = 0.0;
};

struct ProbabilityRequest {
  ProbabilityMethod method = ProbabilityMethod::automatic;
  ContactMeaning contact = ContactMeaning::fcl;

  /// The query stops when upper - lower <= max(absolute_tolerance, relative_tolerance * upper).
  /// Both >= 0 and not both 0. For estimates the same holds for the standard error.
  double relative_tolerance = 0.01;
  double absolute_tolerance = 1e-6;

  /// Decide on which side of this probability P lies, and stop as soon as that is certain (methods
  /// that sample: with their `confidence`). Only that or a limit ends the query then; tolerances do
  /// not, however close to it P is. Method `estimate` ends at its tolerance all the same: its
  /// standard error decides nothing, its interval may.
  std::optional<double> threshold;

  /// Seconds; not set means no limit, so that results repeat.
  std::optional<double> time_limit;

  /// Limits of the partition: cells examined, bytes of its data structures.
  std::size_t max_cells = 2'000'000;
  std::size_t max_memory = std::size_t{1} << 30;

  /// general_pcd: δ, pairs below 1 - δ are not refined. Sampling: coverage of the confidence
  /// interval.
  double confidence = 0.99;

  /// Sampling: number of samples at most, and the seed that fixes all of them.
  std::size_t samples = 10'000;
  std::uint64_t seed = 1;

  /// Threads to use, >= 1: of samples, and of the cells of one interval or estimate. Results do not
  /// depend on it, to the last bit. Where many queries are answered at once each has one thread.
  unsigned threads = 1;

  /// Also compute the gradient of P with respect to the mean displacement (see
  /// ProbabilityResult::gradient for where there is one).
  bool gradient = false;

  /// How far the true shapes of A and B may be from their geometries (of every member, for groups):
  /// the certified interval then holds for all shapes within. For methods `automatic` and
  /// `interval` of pairs, groups, mixtures and batches; others refuse it.
  Band band_a;
  Band band_b;

  /// Called now and then from the calling thread; returning false cancels the query, whose result
  /// is valid all the same (status `cancelled`); it is not called again in that call.
  std::function<bool(const ProbabilityProgress&)> on_progress;

  /// How wide an interval (or how large a standard error) may be where P is `probability`.
  double toleranceAt(double probability) const {
    return std::max(absolute_tolerance, relative_tolerance * probability);
  }

  bool hasBand() const { return !band_a.isZero() || !band_b.isZero(); }
};

/// Checks every field, whether or not the method uses it.
/// \throws InvalidRequest naming the first field that is out of its range, and its value.
void validateRequest(const ProbabilityRequest& request);

/// The names used on the command line and in reports ("auto", "interval", "general-pcd", ...).
std::string toString(ProbabilityMethod method);
std::optional<ProbabilityMethod> methodFromString(const std::string& name);
std::vector<std::string> methodNames();

}  // namespace fcl_prob
