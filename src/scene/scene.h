// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two objects where they are, and how one of them is displaced: all of a query but its question.
#pragma once

#include <memory>
#include <optional>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/whitening.h"
#include "scene/containment.h"
#include "scene/whitened_tree.h"
#include "scene/whole_body.h"

namespace fcl_prob::detail {

/// The objects in the whitened frame, whose first axis is along the direction of closest approach,
/// so that the boundary of the C-obstacle lies across one axis of the cells. They are in it with
/// the bands of the request, or the sweeps of their parts. Everything that is asked of a pair of
/// objects is asked of a QueryScene: what is taken whole and what is solid is said here only.
class QueryScene {
 public:
  /// Keeps references to the objects.
  /// \param all_axes  no axis is left out: for cells within a ball of the whitened frame
  /// \throws InvalidRequest for bands around objects that move by themselves
  ///         InvalidDistribution if all axes are needed and lengths overflow along one of them
  QueryScene(const PartitionObject& a, const PartitionObject& b,
             const GaussianDisplacement& displacement, const ProbabilityRequest& request,
             bool all_axes = false);
  QueryScene(const QueryScene&) = delete;
  QueryScene& operator=(const QueryScene&) = delete;

  const PartitionObject& a() const { return a_; }
  const PartitionObject& b() const { return b_; }

  /// What the cells are of: the displacement without the axes along which all of it is less than
  /// what positions are rounded by. No cell could tell anything along those. How far it moves along
  /// them is part of the errors of pair(), so that what is claimed holds wherever on them A is.
  const GaussianDisplacement& displacement() const { return displacement_; }

  /// Of that.
  const Whitening& whitening() const { return whitening_; }
  int rank() const { return whitening_.rank(); }

  const WhitenedPair& pair() const { return pair_; }

  /// Null: surfaces.
  const SolidContact* solids() const { return solids_.get(); }

  /// An object that is convex, or nearly so; nothing where all triangles matter.
  const std::optional<WholeBody>& wholeBody() const { return whole_body_; }

 private:
  void placeFrame(const ProbabilityRequest& request, bool all_axes);

  const PartitionObject& a_;
  const PartitionObject& b_;
  GaussianDisplacement displacement_;
  Whitening whitening_{GaussianDisplacement()};
  WhitenedPair pair_;
  std::unique_ptr<const SolidContact> solids_;
  std::optional<WholeBody> whole_body_;
};

}  // namespace fcl_prob::detail
