// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh as a few convex parts that cover it.
#pragma once

#include <fcl/geometry/shape/convex.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "fcl_prob/convex_body.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob {

struct DecompositionRequest {
  /// Parts at most, at least 1.
  std::size_t max_parts = 40;

  /// Two parts become one if their common hull exceeds the two by no more than this part of the
  /// volume of the hull of the whole mesh, at least 0: fewer parts than max_parts where more would
  /// bring little. (A mesh without volume: fewer parts only where it is convex.)
  double concavity = 1e-4;

  /// Pieces that the mesh is cut into before they are put together again to parts; at least
  /// max_parts. More pieces take longer and fit better.
  std::size_t pieces = 96;
};

/// Convex polytopes in the frame of a mesh, metres, whose union contains every triangle of it: the
/// displacements at which two meshes touch are among those at which parts of them do. Immutable;
/// copies share their data.
class ConvexParts {
 public:
  /// Cuts the mesh by planes, so that the hulls of the pieces shrink as much as possible, and puts
  /// pieces together again whose common hull is hardly larger (approximate convex decomposition). A
  /// mesh that is convex is one part. The same mesh gives the same parts on every machine with the
  /// same rounding.
  ///
  /// Every part is the hull of its pieces, moved outwards by more than what rounding may have moved
  /// the cuts by (1.3e-10 of the largest coordinate, more for parts of more than 400 faces). That
  /// the parts cover the mesh is proven afterwards, triangle by triangle, from the parts alone.
  /// \throws InvalidGeometry if the mesh is malformed, its largest coordinate is above 0 and below
  /// 1e-290 m, or the cover cannot be proven;
  /// InvalidRequest if a number is out of its range
  explicit ConvexParts(const TriangleMesh& mesh, const DecompositionRequest& request = {});

  /// The hulls of points that somebody else has put together (V-HACD, CoACD, a file of `fcl_prob
  /// decompose`), in the frame of the mesh, metres: moved outwards and proven as those above.
  /// \throws InvalidGeometry as above, and for a part without points or with one that is not
  ///         finite; InvalidRequest without a part
  ConvexParts(const TriangleMesh& mesh, const std::vector<std::vector<Eigen::Vector3d>>& parts);

  std::size_t size() const;

  /// Whether the parts are proven to contain every point of the solid that the mesh encloses, too:
  /// a closed mesh of whose box nothing inside is left once the parts are taken off. False for a
  /// mesh that is not closed.
  bool coversSolid() const;

  /// Its corners and faces. Parts of flat meshes are as thick as they are moved outwards.
  const ConvexPolytope& polytope(std::size_t part) const;

  /// The same for bounds and masses of pairs: fcl_prob/convex_pcd.h.
  const ConvexBody& body(std::size_t part) const;

  /// Volume of a part, cubic metres.
  double volume(std::size_t part) const;

  /// The same for FCL: one object a part.
  std::shared_ptr<const fcl::Convexd> geometry(std::size_t part) const;

  /// Which two parts make the smallest hull together, then which two of what is left, and so on:
  /// parts have the numbers below size(), unions those that follow in this order.
  const std::vector<std::pair<std::size_t, std::size_t>>& unions() const;

  /// All parts as geometries, for GroupQuery and FCL's managers: objects with one displacement.
  std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> geometries() const;

 private:
  struct Data;

  /// Of a mesh and points that are scaled by two to the power of minus `exponent`.
  void fill(const TriangleMesh& mesh, const std::vector<std::vector<Eigen::Vector3d>>& parts,
            int exponent);

  std::shared_ptr<const Data> data_;
};

}  // namespace fcl_prob
