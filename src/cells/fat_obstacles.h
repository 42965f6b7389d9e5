// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of one convex mesh, taken whole, and the pieces of another mesh.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <vector>

#include "base/constants.h"
#include "scene/whitened_fan.h"
#include "scene/whitened_polygons.h"

namespace fcl_prob::detail {

/// A plane of a C-obstacle V in the whitened frame: V lies in { n·y <= outer }, |n| = 1. What lies
/// in { n·y <= outer - margin } for all planes of V belongs to V.
struct ObstaclePlane {
  Eigen::Vector3d n;
  double outer;
  double margin;

  double inner() const { return outer - margin; }
};

/// V_t = P ⊕ T_t for every piece t of the mesh, a triangle or a polygon (docs/rounding.md
/// tells what its planes are): planes across the normals of P, offset by the piece's extent, are
/// shared by all; those across an edge of the piece and one of P, and the piece's own, are made
/// when they are first asked for, by any of several threads. All is relative to the centre of P,
/// which is within P.
class FatObstacles : public WhitenedFan {
 public:
  FatObstacles(const WhitenedPair& pair, const PieceTree::Part& part, const ConvexFan& fan,
               bool fan_is_a, const Eigen::Matrix3d& linear, const WhitenedPolygons& pieces);

  /// Of one of so many pieces that has not been asked for anything.
  static std::size_t leastMemory(std::size_t pieces) { return pieces * sizeof(Slot); }

  /// The offsets of the face planes of V_t (see ObstaclePlane::outer), without what is added for
  /// rounding.
  const std::vector<double>& faceOffsets(int piece);

  /// All other planes.
  const std::vector<ObstaclePlane>& otherPlanes(int piece);

  /// How many of these are across the normals of the piece itself: the first ones.
  int ownPlanes(int piece) const { return known(piece).own; }

  /// All planes of V_t, by index: the faces', and from faceCount() on the others.
  class Planes;

  /// The others must have been made: those that are left out move the faces'.
  Planes planesOf(int piece) const;

  /// Not below the margin of any face plane of V_t.
  double mostMargin(int piece) const { return largestMargin() + known(piece).loss; }

  /// Whether a polygon is known well enough.
  bool mayTakePolygon(int polygon) const { return lossOf(polygon) <= pieces_.mostLoss(); }

  /// Whether the piece or an edge of it turned out too degenerate for anything to be said of what
  /// its obstacle contains.
  bool hasFailed(int piece) const { return !(known(piece).loss < kNever); }

  /// Whether that is so of any triangle that was asked for. (A polygon has its triangles instead.)
  bool failed() const { return failed_; }

  /// In which half of the doubled middle of T ⊕ P: a point of V_t.
  Eigen::Vector3d middle(int piece) const;

  /// The largest n·y on T_t, and what is off that.
  double extent(int piece, const Eigen::Vector3d& n) const {
    double highest = -kInfinity;
    pieces_.visitCorners(piece,
                         [&](int vertex) { highest = std::max(highest, n.dot(corner(vertex))); });
    return highest + pieces_.offOf(piece);
  }

  /// Box of P ⊕ T_t.
  NodeBox obstacleBoxOf(int piece) const;

  const WhitenedPolygons& pieces() const { return pieces_; }

  std::size_t memory() const { return memory_; }
  std::size_t built() const { return built_; }

 private:
  static constexpr double kNever = 1e300;

  // What a polygon is off, as a share of P around 0: more than that, as P is shrunk besides.
  static constexpr double kMoreThanShare = 1.01;

  struct Details {
    std::vector<double> offsets;
    std::vector<ObstaclePlane> planes;
    std::atomic<bool> has_planes{false};
    int own = 0;        ///< of the planes
    double loss = 0.0;  ///< added to all margins
  };

  /// What is in it stays once it is there.
  struct Slot {
    std::atomic<Details*> details{nullptr};

    Slot() = default;
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;
    ~Slot() { delete details.load(); }
  };

  const Details& known(int piece) const {
    return *details_[static_cast<std::size_t>(piece)].details.load(std::memory_order_acquire);
  }
  std::mutex& mutexOf(int piece) { return mutexes_[piece % mutexes_.size()]; }
  Details& details(int piece);
  Details* newDetails(int piece);
  void buildPlanes(int piece, Details& into);
  void buildTriangle(int piece, Details& into);
  void buildPolygon(int piece, Details& into);
  void addTriangleNormal(const Eigen::Matrix3d& corners, Details& into) const;
  /// Of a triangle or polygon, which lies on the side of `inward` of an edge.
  template <typename Corners>
  void addEdge(const Corners& corners, double off, const Eigen::Vector3d& along,
               const Eigen::Vector3d& inward, Details& into) const;
  Eigen::Matrix3Xd cornersOf(int polygon) const;
  /// What is added to its margins.
  double lossOf(int polygon) const {
    return (2 + kMoreThanShare * roundness()) * pieces_.offOf(polygon);
  }
  std::vector<int> arcsAcross(const Eigen::VectorXd& on_normals, double parallel) const;
  ObstaclePlane planeAcross(double extent, const Eigen::Vector3d& n, double of_p) const;

  const WhitenedPolygons& pieces_;
  std::vector<Slot> details_;
  std::array<std::mutex, 16> mutexes_;  ///< each for what is made of some of the triangles
  std::atomic<bool> failed_{false};
  std::atomic<std::size_t> memory_{0};
  std::atomic<std::size_t> built_{0};
};

class FatObstacles::Planes {
 public:
  ObstaclePlane operator[](int index) const {
    if (index >= body_.faceCount()) return of_.planes[index - body_.faceCount()];
    return {body_.faceNormal(index), of_.offsets[index] + body_.facePad(index),
            body_.faceMargin(index) + of_.loss};
  }

 private:
  friend class FatObstacles;
  Planes(const FatObstacles& body, const Details& of) : body_(body), of_(of) {}

  const FatObstacles& body_;
  const Details& of_;
};

inline FatObstacles::Planes FatObstacles::planesOf(int piece) const {
  return {*this, known(piece)};
}

}  // namespace fcl_prob::detail
