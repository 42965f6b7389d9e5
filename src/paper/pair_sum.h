// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// GeneralPCD on pairs of nodes: what to refine, and what is added up.
#pragma once

#include "fcl_prob/general_pcd.h"
#include "paper/node_pairs.h"

namespace fcl_prob::detail {

/// Decides for one pair after another whether it is refined, and adds up those that are not.
class PairSum {
 public:
  PairSum(NodePairs& pairs, const GeneralPcdRequest& request)
      : pairs_(pairs), request_(request), threshold_(1.0 - request.confidence) {
    pairs_.setNegligible(request.negligible);
  }

  NodePairs& pairs() { return pairs_; }

  /// The bound of a pair; of two leaves by what the request asks for.
  double bound(int node_a, int node_b);

  /// Whether a pair with this bound is to be refined.
  bool refines(int node_a, int node_b, double bound);

  void add(int node_a, int node_b, double bound);

  /// Replaces the sum.
  void set(double bound);
  bool finished() const { return request_.stop_at_one && result_.raw_sum >= 1.0; }

  GeneralPcdResult result() const;

 private:
  /// Whether the limits of the request are reached.
  bool mayNotRefine() const;

  NodePairs& pairs_;
  const GeneralPcdRequest& request_;
  double threshold_;
  GeneralPcdResult result_;
};

/// Algorithm 2 on any trees, depth first.
void sumRecursively(PairSum& sum, int node_a, int node_b);

/// min(parent, sum over the children), depth first; leaves a subtree as soon as it is seen to bring
/// nothing. Its result has no sum.
double minimumRecursively(PairSum& sum, int node_a, int node_b, double bound);

/// GeneralPCD on any trees, in the variant of the request.
GeneralPcdResult generalPcdOver(NodePairs& pairs, const GeneralPcdRequest& request);

/// \throws InvalidRequest naming the first field that is out of its range
void validateGeneralPcdRequest(const GeneralPcdRequest& request);

}  // namespace fcl_prob::detail
