// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where convex meshes can be taken whole, not triangle by triangle.
#pragma once

#include <optional>

#include "fcl_prob/gaussian_displacement.h"
#include "scene/partition_object.h"
#include "scene/whitened_fan.h"

namespace fcl_prob::detail {

/// An object of which every member is convex (or nearly), a mesh or a polytope, and the mesh beside
/// it.
struct WholeBody {
  const PartitionObject& body;
  const PartitionObject& mesh;
  bool body_is_a;
};

/// Nothing unless both hold still, one is a mesh, the other one convex (or nearly), and the
/// displacement has rank 3 and is not so stretched that planes across its edges would be known
/// poorly. Of two that are convex the one with more triangles is taken whole; one that is nearly
/// convex only if there is no other. Refers to the arguments.
std::optional<WholeBody> wholeBodyOf(const PartitionObject& a, const PartitionObject& b,
                                     const GaussianDisplacement& displacement);

/// What a plan says where there is none.
constexpr const char* kNoWholeBody =
    "no object is convex or nearly so, or deviations are too unequal";

/// Whether part of the mesh may be within a member and not touch it, where its surface counts.
/// \param fan  the member, or a body around it
bool mayHoldPart(const WholeBody& whole, std::size_t member, const WhitenedFan& fan);

}  // namespace fcl_prob::detail
