// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_carver.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "cells/cell_split.h"

namespace fcl_prob::detail {
namespace {

// The constants only steer; no bound depends on them.

// Boxes wider than this are halved before obstacles are looked at one by one: their lists are what
// takes time. A decision looks closely at few boxes, and was slower with more of them (bench
// states).
constexpr double kWidestBox = 1.0;
constexpr double kWidestBoxOfDecision = 1.5;

// The accuracy of a part that stays in an open cell, as a share of the cell's gap, and the worst.
constexpr double kInnerShare = 0.1;
constexpr double kInnerAccuracy = 0.02;

// Cutting stops when no more than this share of a cell's gap is left around its best obstacle.
constexpr double kLazyShare = 0.02;

// Obstacles that are tried as the best one of a cell.
constexpr int kMostCandidates = 6;

// Less of a cell than this along a plane's normal is not worth cutting off.
constexpr double kLeastTrimmed = 0.3;

// A plane over which a cell sticks out by no more is not cut.
constexpr double kTouching = 2 * CellPolytope::kSnap;

// For what is cut from a cell, or for all of it.
CarvedCell partOf(const CarvedCell& cell, const std::shared_ptr<ObstacleList>& list) {
  CarvedCell part;
  part.list = list;
  part.layers = cell.layers;
  part.rim = cell.rim;
  return part;
}

}  // namespace

CellCarver::CellCarver(FatMembers& obstacles, const SolidContact* solids,
                       const ProbabilityRequest& request, std::atomic<std::size_t>& list_memory,
                       ProbabilityStatistics& statistics)
    : obstacles_(obstacles),
      request_(request),
      list_memory_(list_memory),
      statistics_(statistics),
      lister_(obstacles, statistics),
      chooser_(obstacles),
      settler_(solids, request) {}

void CellCarver::divide(CarvedCell&& cell, double certain, Carving& into) {
  carving_ = &into;
  settler_.begin(certain, into);
  ++statistics_.cells;
  if (cell.box && isTooLarge(*cell.box)) {
    divideBox(std::move(cell));
  } else {
    resolve(std::move(cell));
  }
}

bool CellCarver::isTooLarge(const Cell& box) const {
  return (box.hi - box.lo).maxCoeff() > (request_.threshold ? kWidestBoxOfDecision : kWidestBox);
}

void CellCarver::divideBox(CarvedCell&& cell) {
  const CellSplit at = chooseSplit(*cell.box, Eigen::Vector3d::Ones());
  for (const bool upper : {false, true}) {
    CarvedCell half;
    half.box = cell.box;
    (upper ? half.box->lo : half.box->hi)[at.axis] = at.at;
    half.mass = cellMass(*half.box);
    const std::vector<FatNode>& nodes = lister_.nodesIn(*half.box, *cell.nodes);
    if (!nodes.empty() && !lister_.isCovered(*half.box)) {
      half.nodes = std::make_shared<const std::vector<FatNode>>(nodes);
      push(std::move(half));
      continue;
    }
    half.body = CellPolytope(*half.box);
    if (nodes.empty()) {
      settler_.settleFree(half);
    } else {
      settler_.settleCovered("one fat pair", half);
    }
  }
}

// Its memory is counted as long as cells refer to it.
std::shared_ptr<ObstacleList> CellCarver::copied(const List& list) {
  std::shared_ptr<List> copy{new List(list), [this](List* old) {
                               list_memory_ -= old->counted;
                               delete old;
                             }};
  copy->counted = copy->memory();
  list_memory_ += copy->counted;
  return copy;
}

void CellCarver::resolve(CarvedCell&& cell) {
  if (cell.box) cell.body = CellPolytope(*cell.box);
  found_.entries.clear();
  found_.planes.clear();
  const Relation relation = lister_.list(cell, found_);
  statistics_.peak_front = std::max(statistics_.peak_front, found_.entries.size());
  if (lister_.failed()) return;  // so has the engine
  if (relation == Relation::covered) return settler_.settleCovered("one fat pair", cell);
  if (relation == Relation::free) return settler_.settleFree(cell);
  if (!cell.box) trim(cell, found_);
  if (cell.body.empty()) return;
  carve(cell, copied(found_));
}

// The part of a body within all planes of an obstacle. Those first that cut off the most: others
// then cut nothing.
bool CellCarver::clip(const CellPolytope& body, const List& list, std::size_t entry,
                      CellPolytope& inside) {
  const FatObstacles::Planes planes = obstacles_.planesOf(list.entries[entry].obstacle);
  depths_.clear();
  for (std::size_t p = list.entries[entry].first; p < list.entries[entry].last; ++p) {
    const ObstaclePlane plane = planes[list.planes[p]];
    const CellPolytope::Extent extent = body.along(plane.n);
    const double depth = plane.inner() - extent.lo;
    if (depth < -CellPolytope::kSnap) return false;
    depths_.emplace_back(depth, list.planes[p]);
  }
  std::sort(depths_.begin(), depths_.end());
  inside = body;
  for (const auto& [unused, index] : depths_) {
    const ObstaclePlane plane = planes[index];
    cutter_.cut(inside, plane.n, plane.inner(), &inside, nullptr);
    if (inside.empty()) return false;
  }
  return true;
}

// What lies behind one plane of an obstacle is often not reached by the others but next to it.
void CellCarver::trim(CarvedCell& cell, const List& list) {
  const Eigen::Vector3d& n = cell.behind;
  if (n.isZero()) return;
  supports_.assign(static_cast<std::size_t>(obstacles_.count()), std::nan(""));
  double top = -kInfinity;
  for (const List::Entry& entry : list.entries) {
    const auto& [member, piece] = entry.obstacle;
    const FatObstacles& body = obstacles_.of(member);
    double& support = supports_[member];
    if (std::isnan(support)) support = body.support(n) + body.padding(n);
    top = std::max(top, support + body.extent(piece, n));
  }
  const CellPolytope::Extent extent = cell.body.along(n);
  if (!(extent.hi - top > kLeastTrimmed * (extent.hi - extent.lo))) return;
  settler_.allowSlivers(cell.body, 1);
  CarvedCell beyond = partOf(cell, nullptr);
  cutter_.cut(cell.body, n, top + 2 * CellPolytope::kCutLayer, &cell.body, &beyond.body);
  if (beyond.body.empty()) return;
  beyond.mass = cell.mass;
  if (settler_.hasSolids()) beyond.mass = CellSettler::openMass(beyond.body, cell.mass.upper);
  settler_.settleFree(beyond);
  if (!cell.body.empty()) cell.mass = CellSettler::openMass(cell.body, cell.mass.upper);
}

void CellCarver::carve(CarvedCell& cell, const std::shared_ptr<List>& list) {
  CellPolytope inside;
  for (int tried = 0; tried < kMostCandidates; ++tried) {
    const std::size_t best = chooser_.best(cell.body, *list);
    if (clip(cell.body, *list, best, inside)) {
      carveBy(cell, list, best, inside);
      return;
    }
    dropEntry(cell, *list, best);
    if (list->entries.empty()) return settler_.settleFree(cell);
  }
  split(cell, list);
}

// Whether anything of a body is within all outer planes of an obstacle. None of them need be beyond
// the body, as one has to be for the lister to see that.
bool CellCarver::mayMeet(const CellPolytope& body, const List& list, std::size_t entry) {
  const auto& [obstacle, first, last] = list.entries[entry];
  const FatObstacles::Planes planes = obstacles_.planesOf(obstacle);
  settler_.allowSlivers(body, last - first);
  CellPolytope rest = body;
  for (std::size_t p = first; p < last; ++p) {
    const ObstaclePlane plane = planes[list.planes[p]];
    cutter_.cut(rest, plane.n, plane.outer + 2 * CellPolytope::kCutLayer, &rest, nullptr);
    if (rest.empty()) return false;
  }
  return true;
}

// An obstacle that does not meet a cell, or in no more than the layer between its inner and outer
// planes.
void CellCarver::dropEntry(CarvedCell& cell, List& list, std::size_t entry) {
  if (!mayMeet(cell.body, list, entry)) {
    list.entries.erase(list.entries.begin() + static_cast<std::ptrdiff_t>(entry));
    return;
  }
  CellPolytope rest = cell.body;
  CarvedCell outside;
  const FatObstacles::Planes planes = obstacles_.planesOf(list.entries[entry].obstacle);
  for (std::size_t p = list.entries[entry].first; p < list.entries[entry].last; ++p) {
    const ObstaclePlane plane = planes[list.planes[p]];
    cutter_.cut(rest, plane.n, plane.inner(), &rest, &outside.body);
    if (!outside.body.empty()) {
      outside.mass = CellSettler::openMass(outside.body, cell.mass.upper);
      settler_.allowLayer(outside, plane);
    }
    settler_.allowSlivers(cell.body, 1);
    if (rest.empty()) break;
  }
  settler_.leaveUnknown(CellSettler::openMass(rest, cell.mass.upper).upper);  // of nothing
  if (settler_.hasSolids()) cell.rim = std::max(cell.rim, rimOf(cell, list, entry));
  list.entries.erase(list.entries.begin() + static_cast<std::ptrdiff_t>(entry));
}

// How far an obstacle V that is dropped reaches into a cell. Within its inner planes there is
// nothing of the cell, so that some plane is between the two; and V is within what is between its
// inner planes once that is stretched, about a point of it, by as much as the outer planes are
// farther away.
double CellCarver::rimOf(const CarvedCell& cell, const List& list, std::size_t entry) const {
  const auto& [obstacle, first, last] = list.entries[entry];
  const FatObstacles::Planes planes = obstacles_.planesOf(obstacle);
  const Eigen::Vector3d within = obstacles_.of(obstacle.member).middle(obstacle.piece);
  double stretched = 0.0;
  for (std::size_t p = first; p < last; ++p) {
    const ObstaclePlane plane = planes[list.planes[p]];
    const double depth = plane.inner() - CellPolytope::kCutLayer - plane.n.dot(within);
    if (!(depth > 0.0)) return kInfinity;
    stretched = std::max(stretched, (plane.margin + 3 * CellPolytope::kCutLayer) / depth);
  }
  return stretched * (cell.body.middle() - within).norm() + CellPolytope::kCutLayer;
}

void CellCarver::carveBy(CarvedCell& cell, const std::shared_ptr<List>& list, std::size_t best,
                         const CellPolytope& inside) {
  // The better the more of the cell is known already.
  const double accuracy =
      std::clamp(kInnerShare * cell.gap() / cell.mass.upper, settler_.accuracy(), kInnerAccuracy);
  const Bounds inner =
      inside.mass({accuracy, CellSettler::kOpenFloor * accuracy * cell.mass.upper});
  const List::Entry entry = list->entries[best];
  const bool is_hull = obstacles_.encloses(entry.obstacle.member);
  Rest rest{cell.body, {}, cell.mass.upper, entry.obstacle};
  const FatObstacles::Planes planes = obstacles_.planesOf(entry.obstacle);
  for (std::size_t p = entry.first; p < entry.last; ++p) {
    rest.planes.push_back(planes[list->planes[p]]);
  }
  settler_.allowSlivers(cell.body, entry.last - entry.first);  // the same cuts in another order
  const double enough = inner.lower + kLazyShare * (cell.mass.upper - inner.lower);
  while (const auto plane = nextPlane(rest)) {
    if (!is_hull && rest.mass <= enough && list->entries.size() > 1) {
      CarvedCell kept = partOf(cell, list);
      kept.mass = {0.0, std::max(rest.mass, inner.upper)};
      kept.inner = inner.lower;
      kept.inner_error = inner.width();
      kept.body = std::move(rest.body);
      return push(std::move(kept));
    }
    cutOff(cell, list, *plane, rest);
  }
  if (is_hull) {
    settler_.leaveUnknown(inner.upper);
    return;
  }
  settler_.settleInside(inside);
}

// The plane that cuts off most, which is taken from the list; those that cut nothing are dropped.
std::optional<ObstaclePlane> CellCarver::nextPlane(Rest& rest) {
  std::vector<ObstaclePlane>& planes = rest.planes;
  std::size_t next = 0;
  double most = 0.0;
  for (std::size_t p = 0; p < planes.size();) {
    const CellPolytope::Extent extent = rest.body.along(planes[p].n);
    const double excess = extent.hi - planes[p].inner();
    if (excess <= kTouching) {
      planes[p] = planes.back();
      planes.pop_back();
      continue;
    }
    const double share = excess / (extent.hi - extent.lo);
    if (share > most) {
      most = share;
      next = p;
    }
    ++p;
  }
  if (!(most > 0.0)) return std::nullopt;
  const ObstaclePlane plane = planes[next];
  planes[next] = planes.back();
  planes.pop_back();
  return plane;
}

// What lies behind a plane of the obstacle becomes a cell of its own.
void CellCarver::cutOff(const CarvedCell& cell, const std::shared_ptr<List>& list,
                        const ObstaclePlane& plane, Rest& rest) {
  CarvedCell outside = partOf(cell, list);
  cutter_.cut(rest.body, plane.n, plane.inner(), &rest.body, &outside.body);
  settler_.allowSlivers(cell.body, 1);
  if (outside.body.empty()) return;
  outside.mass = CellSettler::openMass(outside.body, cell.mass.upper);
  rest.mass -= outside.mass.lower;
  const double layer = settler_.allowLayer(outside, plane);
  outside.layers =
      std::make_shared<const CarvedLayer>(CarvedLayer{plane.n, plane.outer, layer, cell.layers});
  if (list->entries.size() == 1) return settler_.settleFree(outside);
  outside.behind = plane.n;
  outside.outside_of = rest.obstacle;
  push(std::move(outside));
}

// Across its longest side.
void CellCarver::split(const CarvedCell& cell, const std::shared_ptr<List>& list) {
  int axis = 0;
  double longest = -1.0;
  for (int k = 0; k < 3; ++k) {
    const CellPolytope::Extent extent = cell.body.along(Eigen::Vector3d::Unit(k));
    if (extent.hi - extent.lo > longest) {
      longest = extent.hi - extent.lo;
      axis = k;
    }
  }
  CarvedCell halves[] = {partOf(cell, list), partOf(cell, list)};
  cutter_.cut(cell.body, Eigen::Vector3d::Unit(axis), cell.body.middle()[axis], &halves[0].body,
              &halves[1].body);
  settler_.allowSlivers(cell.body, 1);
  for (CarvedCell& half : halves) {
    if (half.body.empty()) continue;
    half.mass = CellSettler::openMass(half.body, cell.mass.upper);
    push(std::move(half));
  }
}

}  // namespace fcl_prob::detail
