// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "paper/pair_sum.h"

#include <algorithm>

#include "base/interruption.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

/// Sums of many bounds stay upper bounds when each addition is rounded up.
double addedUp(double a, double b) { return (a + b) * (1.0 + 0x1p-52); }

}  // namespace

double PairSum::bound(int node_a, int node_b) {
  ++result_.pairs_bounded;
  const bool root = node_a == 0 && node_b == 0;
  const bool exact = root || request_.variant == GeneralPcdVariant::minimum || mayNotRefine() ||
                     pairs_.areLeaves(node_a, node_b);
  pairs_.setEnough(exact ? PairBounds::kNeverEnough : threshold_);
  double bound = pairs_.bound(node_a, node_b);
  if (root) result_.root = bound;
  if (request_.leaf_bound == LeafBound::triangles && pairs_.areLeaves(node_a, node_b) &&
      bound >= threshold_) {
    bound = std::min(bound, pairs_.pieceBound(node_a, node_b));
  }
  return bound;
}

bool PairSum::refines(int node_a, int node_b, double bound) {
  if (bound < threshold_ || pairs_.areLeaves(node_a, node_b)) return false;
  if (!mayNotRefine()) return true;
  result_.complete = false;
  return false;
}

bool PairSum::mayNotRefine() const {
  return result_.pairs_bounded >= request_.max_pairs || finished() || isDue(request_.interruption);
}

void PairSum::add(int node_a, int node_b, double bound) {
  result_.raw_sum = addedUp(result_.raw_sum, bound);
  ++result_.pairs_summed;
  if (pairs_.areLeaves(node_a, node_b)) ++result_.leaf_pairs;
}

void PairSum::set(double bound) {
  result_.raw_sum = bound;
  result_.pairs_summed = 1;
}

GeneralPcdResult PairSum::result() const {
  GeneralPcdResult result = result_;
  result.upper = std::min(1.0, result.raw_sum);
  if (finished()) result.complete = false;
  return result;
}

void sumRecursively(PairSum& sum, int node_a, int node_b) {
  const double bound = sum.bound(node_a, node_b);
  if (!sum.refines(node_a, node_b, bound)) {
    sum.add(node_a, node_b, bound);
    return;
  }
  const auto [first_pair, second_pair] = sum.pairs().children(node_a, node_b);
  sumRecursively(sum, first_pair.a, first_pair.b);
  sumRecursively(sum, second_pair.a, second_pair.b);
}

double minimumRecursively(PairSum& sum, int node_a, int node_b, double bound) {
  if (!sum.refines(node_a, node_b, bound)) return bound;
  const auto [first_pair, second_pair] = sum.pairs().children(node_a, node_b);
  const double first_bound = sum.bound(first_pair.a, first_pair.b);
  const double first = minimumRecursively(sum, first_pair.a, first_pair.b, first_bound);
  if (first >= bound) return bound;
  const double second_bound = sum.bound(second_pair.a, second_pair.b);
  const double second = minimumRecursively(sum, second_pair.a, second_pair.b, second_bound);
  return std::min(bound, addedUp(first, second));
}

GeneralPcdResult generalPcdOver(NodePairs& pairs, const GeneralPcdRequest& request) {
  PairSum sum(pairs, request);
  if (request.variant == GeneralPcdVariant::sum) {
    sumRecursively(sum, 0, 0);
  } else {
    const double root = sum.bound(0, 0);
    sum.set(minimumRecursively(sum, 0, 0, root));
  }
  return sum.result();
}

void validateGeneralPcdRequest(const GeneralPcdRequest& request) {
  if (!(request.confidence >= 0.0 && request.confidence <= 1.0)) {
    throw InvalidRequest("confidence is " + numberText(request.confidence) + ", must be in [0, 1]");
  }
  if (!(request.negligible >= 0.0)) {
    throw InvalidRequest("negligible is " + numberText(request.negligible) +
                         ", must be at least 0");
  }
  if (request.max_pairs == 0) throw InvalidRequest("max_pairs is 0, must be at least 1");
}

}  // namespace fcl_prob::detail
