// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A first, certified interval where convex meshes are taken whole.
#pragma once

#include "carving/whole_body_lines.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

struct ColumnBounds {
  Bounds bounds;
  double likely;  ///< P, about
  std::size_t columns;
};

/// Certified, from columns across the nearest contact: no line of a column meets anything before
/// the boxes of the mesh's tree, and all of them meet the convex mesh put to one point of the other
/// one. Ends when it is certain on which side of the threshold P lies, or when that would likely
/// take more columns than pay.
ColumnBounds columnBounds(WholeBodyLines& lines, double threshold);

}  // namespace fcl_prob::detail
