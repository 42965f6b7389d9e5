// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacle of one convex pair: all displacements at which the two touch.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "convex/convex_set.h"
#include "convex/face_set.h"
#include "convex/minkowski_sum.h"
#include "convex/pair_frame.h"
#include "convex/slab_polytope.h"
#include "convex/zonotope.h"

namespace fcl_prob::detail {

/// Memory that the faces of one C-obstacle after another are built in.
struct ObstacleScratch {
  FaceSet faces;
  MinkowskiSum sum;
  ConvexMesh reflected;
  Interruption interruption;  ///< when it is due, faces are those of a box
};

/// What faces that enclose a C-obstacle say of it.
struct EnclosingFaces {
  double error = 0.0;     ///< how far it may still reach out of them (metres, world frame)
  bool only_box = false;  ///< they are a box around it, for want of better ones
};

/// The image of a ball under the whitening.
struct Ellipsoid {
  Eigen::Vector3d centre;
  double radius;  ///< of the ball, metres, with PairFrame::ball_stretch

  /// The point nearest to the mean, as a direction in the whitened frame: one-dimensional search
  /// for the Lagrange multiplier. Zero if the mean is inside.
  Eigen::Vector3d nearestPoint(const PairFrame& frame) const;
};

/// V = B ⊕ (−A) in the whitened frame of a PairFrame, which must outlive it. Support values are
/// never below the true ones.
class CObstacle {
 public:
  explicit CObstacle(const PairFrame& frame) : frame_(frame) {}
  virtual ~CObstacle() = default;

  const PairFrame& frame() const { return frame_; }

  /// max of direction·y over V, rounding added.
  double support(const Eigen::Vector3d& direction) const;
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;

  /// Writes the (whitened) faces of an enclosing polytope to scratch.faces; if they cannot be had
  /// (rounding, an interruption), those of an enclosing box.
  EnclosingFaces outerFaces(ObstacleScratch& scratch) const;

  /// Whether that polytope is V itself (and not a circumscribed one).
  virtual bool isPolytope() const = 0;

  /// Set if V is the image of a ball.
  virtual std::optional<Ellipsoid> ellipsoid() const { return std::nullopt; }

 protected:
  // In world axes, metres, relative to the mean.
  virtual Eigen::Vector3d worldSupportPoint(const Eigen::Vector3d& direction) const = 0;
  /// Returns how far V may reach out of the faces, beyond PairFrame::error; nothing on failure.
  virtual std::optional<double> worldFaces(ObstacleScratch& scratch) const = 0;

 private:
  const PairFrame& frame_;
};

/// The C-obstacle of two rounded zonotopes: two boxes (15 pairs of planes; 3 if their axes agree),
/// two spheres, two RSS, ... A rounding is circumscribed by a rhombic triacontahedron.
class ZonotopeObstacle final : public CObstacle {
 public:
  ZonotopeObstacle(const PairFrame& frame, const RoundedZonotope& a, const RoundedZonotope& b);

  bool isPolytope() const override { return radius_ == 0.0; }
  std::optional<Ellipsoid> ellipsoid() const override;

 protected:
  Eigen::Vector3d worldSupportPoint(const Eigen::Vector3d& direction) const override;
  std::optional<double> worldFaces(ObstacleScratch& scratch) const override;

 private:
  Zonotope core_;
  double radius_;
};

/// The C-obstacle of any two convex sets.
class ConvexSetObstacle final : public CObstacle {
 public:
  enum class Faces { outer, inner };

  ConvexSetObstacle(const PairFrame& frame, const ConvexSet& a, const ConvexSet& b,
                    Faces faces = Faces::outer)
      : CObstacle(frame), a_(a), b_(b), faces_(faces) {}

  bool isPolytope() const override { return a_.isPolytope() && b_.isPolytope(); }

 protected:
  Eigen::Vector3d worldSupportPoint(const Eigen::Vector3d& direction) const override;
  std::optional<double> worldFaces(ObstacleScratch& scratch) const override;

 private:
  const ConvexSet& a_;
  const ConvexSet& b_;
  Faces faces_;
};

/// Memory of a SlabObstacle.
struct SlabScratch {
  std::vector<Slab> slabs_a;
  std::vector<Slab> slabs;
  CutPolytope work;
  FaceSet faces;
};

/// The C-obstacle of two k-DOPs whose directions are the same in the world frame: their slabs
/// added, O(k) as in the paper. (That polytope contains V; it is V itself only for k = 6.)
class SlabObstacle final : public CObstacle {
 public:
  /// \param scratch  holds in `slabs` those of V in the common frame of the two geometries,
  /// relative to
  ///                 PairFrame::offset; must outlive the obstacle and not serve another one
  SlabObstacle(const PairFrame& frame, SlabScratch& scratch);

  bool isPolytope() const override { return true; }

 protected:
  Eigen::Vector3d worldSupportPoint(const Eigen::Vector3d& direction) const override;
  std::optional<double> worldFaces(ObstacleScratch& scratch) const override;

 private:
  const FaceSet& world_faces_;
};

}  // namespace fcl_prob::detail
