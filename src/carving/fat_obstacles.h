// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of one convex mesh, taken whole, and the triangles of another mesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <mutex>
#include <vector>

#include "pieces/whitened_fan.h"

namespace fcl_prob::detail {

/// A plane of a C-obstacle V in the whitened frame: V lies in { n·y <= outer }, |n| = 1. What lies
/// in { n·y <= outer - margin } for all planes of V belongs to V.
struct ObstaclePlane {
  Eigen::Vector3d n;
  double outer;
  double margin;

  double inner() const { return outer - margin; }
};

/// V_t = P ⊕ T_t for every triangle t of the mesh (docs/rounding.md tells what its planes are):
/// planes across the normals of P, offset by the triangle's extent, are shared by all; those across
/// an edge of the triangle and one of P, and the triangle's own, are made when they are first asked
/// for, by any of several threads. All is relative to the centre of P, which is within P.
class FatObstacles : public WhitenedFan {
 public:
  FatObstacles(const WhitenedPair& pair, const PieceTree::Part& part, const ConvexFan& fan,
               bool fan_is_a, const Eigen::Matrix3d& linear);

  /// Of one of so many triangles that has not been asked for anything.
  static std::size_t leastMemory(std::size_t triangles) { return triangles * sizeof(Slot); }

  /// The offsets of the face planes of V_t (see ObstaclePlane::outer), without what is added for
  /// rounding.
  const std::vector<double>& faceOffsets(int triangle);

  /// All other planes.
  const std::vector<ObstaclePlane>& otherPlanes(int triangle);

  /// All planes of V_t, by index: the faces', and from faceCount() on the others.
  class Planes;

  /// The others must have been made: those that are left out move the faces'.
  Planes planesOf(int triangle) const;

  /// Not below the margin of any face plane of V_t.
  double mostMargin(int triangle) const { return largestMargin() + known(triangle).loss; }

  /// Whether the triangle or an edge of it turned out too degenerate for anything to be said of
  /// what its obstacle contains.
  bool hasFailed(int triangle) const { return !(known(triangle).loss < kNever); }

  /// Whether that is so of any of those that were asked for.
  bool failed() const { return failed_; }

  /// In which half of the doubled middle of T ⊕ P: a point of V_t.
  Eigen::Vector3d middle(int triangle) const { return corners(triangle).rowwise().mean(); }

  std::size_t memory() const { return memory_; }
  std::size_t built() const { return built_; }

 private:
  static constexpr double kNever = 1e300;

  struct Details {
    std::vector<double> offsets;
    std::vector<ObstaclePlane> planes;
    std::atomic<bool> has_planes{false};
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

  const Details& known(int triangle) const {
    return *details_[static_cast<std::size_t>(triangle)].details.load(std::memory_order_acquire);
  }
  std::mutex& mutexOf(int triangle) { return mutexes_[triangle % mutexes_.size()]; }
  Details& details(int triangle);
  Details* newDetails(int triangle);
  void buildPlanes(int triangle, Details& into);
  void addTriangleNormal(const Eigen::Matrix3d& corners, Details& into) const;
  void addEdge(const Eigen::Matrix3d& corners, int edge, Details& into);
  ObstaclePlane planeAcross(const Eigen::Matrix3d& corners, const Eigen::Vector3d& n,
                            double of_p) const;

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

inline FatObstacles::Planes FatObstacles::planesOf(int triangle) const {
  return {*this, known(triangle)};
}

}  // namespace fcl_prob::detail
