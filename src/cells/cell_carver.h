// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What becomes of one cell of a partition along the planes of the C-obstacles themselves.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "cells/cell_polytope.h"
#include "cells/claim_observer.h"
#include "cells/face_kernels.h"
#include "cells/fat_members.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "scene/containment.h"

namespace fcl_prob::detail {

/// The obstacles that may meet a cell without covering it, each with those of its planes over which
/// the cell sticks out.
struct ObstacleList {
  struct Entry {
    FatObstacle obstacle;
    std::size_t first;  ///< of its planes
    std::size_t last;   ///< one behind the last
  };
  std::vector<Entry> entries;
  std::vector<int> planes;  ///< indices into FatObstacles::planesOf()
  std::size_t counted = 0;  ///< bytes, by whoever counts them

  std::size_t memory() const {
    return entries.capacity() * sizeof(Entry) + planes.capacity() * sizeof(int);
  }
};

/// In { n·y <= outer } a cell may meet obstacles that it is taken to be free of: their mass is in
/// the upper bound already.
struct CarvedLayer {
  Eigen::Vector3d n;
  double outer;
  double mass;                                ///< no less than its own
  std::shared_ptr<const CarvedLayer> before;  ///< of the cell that this one was cut from
};

/// A cell that is still open.
struct CarvedCell {
  CellPolytope body;
  Bounds mass;
  double inner = 0.0;  ///< certified mass of a part that collides

  /// Of the cell that it was cut from, or a box's nodes of the mesh's tree.
  std::shared_ptr<const ObstacleList> list;
  std::optional<Cell> box;
  std::shared_ptr<const std::vector<FatNode>> nodes;

  /// The cell lies behind this plane of an obstacle, if there is one.
  Eigen::Vector3d behind = Eigen::Vector3d::Zero();
  FatObstacle outside_of;

  std::shared_ptr<const CarvedLayer> layers;
  /// Of the list's obstacles of hulls those of what is in the hulls are to be taken instead.
  bool opens_hulls = false;

  /// It may also meet such obstacles elsewhere, no farther than this from its surface.
  double rim = 0.0;

  double inner_error = 0.0;  ///< how much more that part may weigh

  double gap() const { return mass.upper - inner; }
};

/// What cells have come to: mass that is settled for good, and cells that are still open.
struct Carving {
  Bounds settled{0.0, 0.0};
  double slivers = 0.0;  ///< what may lie between cells or belong to two
  std::vector<std::unique_ptr<CarvedCell>> cells;
};

/// What is known before a cell is looked at. Steers; no bound depends on it.
struct CarvedSoFar {
  double certain;     ///< mass that is settled, besides what is in the Carving that is added to
  std::size_t cells;  ///< that were looked at
};

/// What is inside the best obstacle of a cell is settled; what is outside is cut into convex cells
/// along that obstacle's planes, as long as they cut off much. Several of them may work at once
/// over the same obstacles.
class CellCarver {
 public:
  /// Keeps references to all arguments.
  /// \param list_memory  bytes of the lists that cells refer to
  CellCarver(FatMembers& obstacles, const SolidContact* solids, const ProbabilityRequest& request,
             std::atomic<std::size_t>& list_memory, ProbabilityStatistics& statistics);

  /// Adds what comes of a cell. Where obstacles turn out to have failed nothing does.
  void divide(CarvedCell&& cell, const CarvedSoFar& so_far, Carving& into);

 private:
  /// How much may be wrong in one of the tetrahedra of a cell, as a share of what it was cut from.
  static constexpr double kOpenFloor = 0.01;

  using List = ObstacleList;
  enum class Relation { covered, free, cut };

  bool isTooLarge(const Cell& box) const;
  void divideBox(CarvedCell&& cell);
  void gatherNodes(const Cell& box, const std::vector<FatNode>& from, bool to_leaves);
  bool takesPiece(int member, int piece) const;
  bool isBeside(const Cell& box, FatObstacle obstacle);
  bool isCovered(const Cell& box);
  bool covers(const CellBox& box, FatObstacle obstacle);
  void resolve(CarvedCell&& cell);
  Relation listBox(const CarvedCell& cell, List& into);
  void rangeFaces(const CellBox& box, int member);
  Relation addFromBox(const CellBox& box, FatObstacle obstacle, List& into);
  template <typename Add>
  Relation addPieces(FatObstacle obstacle, const Add& add);
  Relation addEntry(FatObstacle obstacle, std::size_t first, List& into) const;
  Relation refine(const CarvedCell& cell, List& into);
  Relation listPieces(const CarvedCell& cell, List& into);
  bool isClear(FatObstacle obstacle, const Cell& box) const;
  Relation addFromBody(const CellPolytope& body, const Cell& box, FatObstacle obstacle, List& into);
  FatObstacles::Planes planesOf(FatObstacle obstacle) const {
    return obstacles_.of(obstacle.member).planesOf(obstacle.piece);
  }
  bool addPlane(const CellPolytope& body, FatObstacle obstacle, int index,
                const ObstaclePlane& plane, List& into);
  Relation examine(const CarvedCell& cell, List& into);
  void takeSamples(const CellPolytope& body);
  std::size_t bestEntry(const CarvedCell& cell, const List& list);
  double scoreOf(const List& list, const List::Entry& entry, double most) const;
  std::shared_ptr<List> copied(const List& list);
  bool mayOpenHulls(const List& list) const;
  void trim(CarvedCell& cell, const List& list);
  void carve(CarvedCell& cell, const std::shared_ptr<List>& list);
  void carveBy(CarvedCell& cell, const std::shared_ptr<List>& list, std::size_t best,
               const CellPolytope& inside);
  void openHulls(CarvedCell& cell, const std::shared_ptr<List>& list);
  /// What is left of a cell around its best obstacle.
  struct Rest {
    CellPolytope body;
    std::vector<ObstaclePlane> planes;  ///< along which it was not cut yet
    double mass;                        ///< no less than its own
    FatObstacle obstacle;
  };
  static std::optional<ObstaclePlane> nextPlane(Rest& rest);
  void cutOff(const CarvedCell& cell, const std::shared_ptr<List>& list, const ObstaclePlane& plane,
              Rest& rest);
  bool clip(const CellPolytope& body, const List& list, std::size_t entry, CellPolytope& inside);
  bool mayMeet(const CellPolytope& body, const List& list, std::size_t entry);
  void dropEntry(CarvedCell& cell, List& list, std::size_t entry);
  double rimOf(const CarvedCell& cell, const List& list, std::size_t entry) const;
  void split(CarvedCell& cell, const std::shared_ptr<List>& list);
  void settle(const Bounds& mass);
  void settleFree(const CarvedCell& cell);
  void settleContained(const CarvedCell& cell, double rim_mass);
  void claim(const char* method, bool collides, const CellPolytope& body,
             const CarvedLayer* layers = nullptr, double rim = 0.0) const;
  double allowLayer(const CarvedCell& outside, const ObstaclePlane& plane);
  Bounds settledMass(const CellPolytope& body) const;
  Bounds openMass(const CellPolytope& body, double parent) const;
  void allowSlivers(const CellPolytope& body, std::size_t cuts);
  void push(CarvedCell&& cell) {
    carving_->cells.push_back(std::make_unique<CarvedCell>(std::move(cell)));
  }

  ClaimObserver* const observer_ = claim_observer;
  FatMembers& obstacles_;
  const SolidContact* solids_;
  const ProbabilityRequest& request_;
  std::atomic<std::size_t>& list_memory_;
  ProbabilityStatistics& statistics_;
  double accuracy_;       ///< relative, of what is settled
  CarvedSoFar so_far_{};  // of the cell that is looked at
  Carving* carving_ = nullptr;
  bool failed_ = false;

  const FaceKernels& kernels_ = faceKernels();
  PolytopeCutter cutter_;
  CellPolytope layer_;
  std::vector<std::pair<double, int>> depths_;  // of a body behind planes, and which
  List found_;
  std::vector<Eigen::Vector3d> samples_;  // of a cell, and what they stand for
  std::vector<double> weights_;
  std::vector<double> face_lo_;  // of a box, along the normals of each P
  std::vector<double> face_hi_;
  std::vector<int> cut_faces_;
  std::vector<bool> ranged_;       // by member: those of its faces are known
  std::vector<FatNode> gathered_;  // that a box may meet
  std::vector<FatNode> stack_;
  std::vector<NodeReach::Heights> lowest_;  // by member, of that box
  /// How far a body reaches along the normals of faces, as far as that was asked for since the
  /// body became another one.
  struct FaceExtent {
    std::size_t asked = 0;
    CellPolytope::Extent extent;
  };
  std::vector<FaceExtent> face_extents_;  // by face of all members
  std::size_t bodies_ = 0;                // that were looked at so
  std::vector<double> supports_;          // by member, along one normal; NaN: not known yet
  std::vector<int> apart_;  // by member: a face that the box was beyond; of the next obstacle, too?
};

}  // namespace fcl_prob::detail
