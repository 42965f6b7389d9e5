// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Cutting a cell along the planes of the obstacle that covers most of it.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/constants.h"
#include "cells/cell_carver.h"

namespace fcl_prob::detail {
namespace {

// The constants only steer; no bound depends on them.

// The accuracy of a part that stays in an open cell, as a share of the cell's gap, and the worst.
constexpr double kInnerShare = 0.1;
constexpr double kInnerAccuracy = 0.02;

// Cutting stops when no more than this share of a cell's gap is left around its best obstacle.
constexpr double kLazyShare = 0.02;

// Obstacles that are tried as the best one of a cell.
constexpr int kMostCandidates = 6;

// Samples of a cell by which its best obstacle is chosen, about.
constexpr std::size_t kSamples = 10;

// What is in hulls and in none of their cores is looked at as long as there are no more cells:
// where the pieces of what is between are many, boxes of triangles come to an end sooner.
constexpr std::size_t kMostCellsOfPieces = 100'000;

// Less of a cell than this along a plane's normal is not worth cutting off.
constexpr double kLeastTrimmed = 0.3;

// A plane over which a cell sticks out by no more is not cut.
constexpr double kTouching = 2 * CellPolytope::kSnap;

}  // namespace

void CellCarver::takeSamples(const CellPolytope& body) {
  const std::vector<Eigen::Vector3d>& vertices = body.vertices();
  const Eigen::Vector3d middle = body.middle();
  samples_.assign(1, middle);
  const std::size_t step = 1 + vertices.size() / kSamples;
  for (std::size_t i = 0; i < vertices.size(); i += step) {
    samples_.push_back(middle + 0.6 * (vertices[i] - middle));
  }
  weights_.clear();
  for (const Eigen::Vector3d& sample : samples_) {
    weights_.push_back(std::exp(0.5 * (middle.squaredNorm() - sample.squaredNorm())));
  }
}

// By how much of the cell's mass is in it, as far as a few samples tell. Hulls come last: they
// settle nothing.
std::size_t CellCarver::bestEntry(const CarvedCell& cell, const List& list) {
  takeSamples(cell.body);
  const auto encloses = [this](const List::Entry& entry) {
    return obstacles_.encloses(entry.obstacle.member);
  };
  const bool only_hulls = std::all_of(list.entries.begin(), list.entries.end(), encloses);
  std::size_t best = 0;
  double most = -kInfinity;
  for (std::size_t e = 0; e < list.entries.size(); ++e) {
    if (!only_hulls && encloses(list.entries[e])) continue;
    const double score = scoreOf(list, list.entries[e], most);
    if (score > most) {
      most = score;
      best = e;
    }
  }
  return best;
}

// The weight of the samples that are within an obstacle, or else less than 0 by how far the nearest
// of them is from it. No more than `most` is as good as any: such an obstacle is given up early,
// and what one sample is beyond the next one probably is, too.
double CellCarver::scoreOf(const List& list, const List::Entry& entry, double most) const {
  const FatObstacles::Planes planes = planesOf(entry.obstacle);
  const double enough = most >= 0.0 ? 0.0 : -most;
  double score = 0.0;
  double nearest = kInfinity;
  double ahead = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  std::size_t beyond = entry.first;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (most > 0.0 && score + ahead <= most) break;
    ahead -= weights_[i];
    const auto excessOver = [&](std::size_t p) {
      const ObstaclePlane plane = planes[list.planes[p]];
      return plane.n.dot(samples_[i]) - plane.inner();
    };
    double excess = beyond < entry.last ? excessOver(beyond) : -kInfinity;
    for (std::size_t p = entry.first; p < entry.last && !(excess > enough); ++p) {
      const double over = excessOver(p);
      if (!(over > excess)) continue;
      excess = over;
      beyond = p;
    }
    if (excess <= 0.0) score += weights_[i];
    nearest = std::min(nearest, excess);
  }
  return score > 0.0 ? score : -nearest;
}

// The part of a body within all planes of an obstacle. Those first that cut off the most: others
// then cut nothing.
bool CellCarver::clip(const CellPolytope& body, const List& list, std::size_t entry,
                      CellPolytope& inside) {
  const FatObstacles::Planes planes = planesOf(list.entries[entry].obstacle);
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
  supports_.assign(static_cast<std::size_t>(obstacles_.memberCount()), std::nan(""));
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
  allowSlivers(cell.body, 1);
  CarvedCell beyond;
  cutter_.cut(cell.body, n, top + 2 * CellPolytope::kCutLayer, &cell.body, &beyond.body);
  if (beyond.body.empty()) return;
  beyond.mass = cell.mass;
  beyond.layers = cell.layers;
  beyond.rim = cell.rim;
  if (solids_) beyond.mass = openMass(beyond.body, cell.mass.upper);
  settleFree(beyond);
  if (!cell.body.empty()) cell.mass = openMass(cell.body, cell.mass.upper);
}

void CellCarver::carve(CarvedCell& cell, const std::shared_ptr<List>& list) {
  CellPolytope inside;
  for (int tried = 0; tried < kMostCandidates; ++tried) {
    if (mayOpenHulls(*list)) return openHulls(cell, list);
    const std::size_t best = bestEntry(cell, *list);
    if (clip(cell.body, *list, best, inside)) {
      carveBy(cell, list, best, inside);
      return;
    }
    dropEntry(cell, *list, best);
    if (list->entries.empty()) return settleFree(cell);
  }
  split(cell, list);
}

// Whether anything of a body is within all outer planes of an obstacle. None of them need be beyond
// the body, as one has to be for refine() to see that.
bool CellCarver::mayMeet(const CellPolytope& body, const List& list, std::size_t entry) {
  const auto& [obstacle, first, last] = list.entries[entry];
  const FatObstacles::Planes planes = planesOf(obstacle);
  allowSlivers(body, last - first);
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
  const FatObstacles::Planes planes = planesOf(list.entries[entry].obstacle);
  for (std::size_t p = list.entries[entry].first; p < list.entries[entry].last; ++p) {
    const ObstaclePlane plane = planes[list.planes[p]];
    cutter_.cut(rest, plane.n, plane.inner(), &rest, &outside.body);
    if (!outside.body.empty()) {
      outside.mass = openMass(outside.body, cell.mass.upper);
      allowLayer(outside, plane);
    }
    allowSlivers(cell.body, 1);
    if (rest.empty()) break;
  }
  carving_->settled.upper += openMass(rest, cell.mass.upper).upper;  // of nothing
  if (solids_) cell.rim = std::max(cell.rim, rimOf(cell, list, entry));
  list.entries.erase(list.entries.begin() + static_cast<std::ptrdiff_t>(entry));
}

// How far an obstacle V that is dropped reaches into a cell. Within its inner planes there is
// nothing of the cell, so that some plane is between the two; and V is within what is between its
// inner planes once that is stretched, about a point of it, by as much as the outer planes are
// farther away.
double CellCarver::rimOf(const CarvedCell& cell, const List& list, std::size_t entry) const {
  const auto& [obstacle, first, last] = list.entries[entry];
  const FatObstacles::Planes planes = planesOf(obstacle);
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
      std::clamp(kInnerShare * cell.gap() / cell.mass.upper, accuracy_, kInnerAccuracy);
  const Bounds inner = inside.mass({accuracy, kOpenFloor * accuracy * cell.mass.upper});
  const List::Entry entry = list->entries[best];
  const bool is_hull = obstacles_.encloses(entry.obstacle.member);
  Rest rest{cell.body, {}, cell.mass.upper, entry.obstacle};
  const FatObstacles::Planes planes = planesOf(entry.obstacle);
  for (std::size_t p = entry.first; p < entry.last; ++p) {
    rest.planes.push_back(planes[list->planes[p]]);
  }
  allowSlivers(cell.body, entry.last - entry.first);  // the same cuts in another order
  const double enough = inner.lower + kLazyShare * (cell.mass.upper - inner.lower);
  while (const auto plane = nextPlane(rest)) {
    if (!is_hull && rest.mass <= enough && list->entries.size() > 1) {
      CarvedCell kept;
      kept.mass = {0.0, std::max(rest.mass, inner.upper)};
      kept.inner = inner.lower;
      kept.inner_error = inner.width();
      kept.list = list;
      kept.body = std::move(rest.body);
      kept.layers = cell.layers;
      kept.rim = cell.rim;
      return push(std::move(kept));
    }
    cutOff(cell, list, *plane, rest);
  }
  if (is_hull) {
    carving_->settled.upper += inner.upper;
    return;
  }
  claim("planes of a fat pair", true, inside);
  settle(settledMass(inside));
}

// Whether there are but hulls, and what is in them can be looked at instead.
bool CellCarver::mayOpenHulls(const List& list) const {
  if (so_far_.cells >= kMostCellsOfPieces) return false;
  return std::all_of(list.entries.begin(), list.entries.end(), [this](const List::Entry& entry) {
    const int member = entry.obstacle.member;
    return obstacles_.encloses(member) && !obstacles_.piecesWithin(member).empty();
  });
}

// Their pieces end in few places of the cell, hulls in many: nothing is cut along hulls.
void CellCarver::openHulls(CarvedCell& cell, const std::shared_ptr<List>& list) {
  CarvedCell open;
  open.mass = {0.0, cell.mass.upper};
  open.body = std::move(cell.body);
  open.list = list;
  open.layers = cell.layers;
  open.rim = cell.rim;
  open.opens_hulls = true;
  push(std::move(open));
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
  CarvedCell outside;
  cutter_.cut(rest.body, plane.n, plane.inner(), &rest.body, &outside.body);
  allowSlivers(cell.body, 1);
  if (outside.body.empty()) return;
  outside.mass = openMass(outside.body, cell.mass.upper);
  rest.mass -= outside.mass.lower;
  const double layer = allowLayer(outside, plane);
  outside.layers =
      std::make_shared<const CarvedLayer>(CarvedLayer{plane.n, plane.outer, layer, cell.layers});
  outside.rim = cell.rim;
  if (list->entries.size() == 1) return settleFree(outside);
  outside.list = list;
  outside.behind = plane.n;
  outside.outside_of = rest.obstacle;
  push(std::move(outside));
}

// Across its longest side.
void CellCarver::split(CarvedCell& cell, const std::shared_ptr<List>& list) {
  int axis = 0;
  double longest = -1.0;
  for (int k = 0; k < 3; ++k) {
    const CellPolytope::Extent extent = cell.body.along(Eigen::Vector3d::Unit(k));
    if (extent.hi - extent.lo > longest) {
      longest = extent.hi - extent.lo;
      axis = k;
    }
  }
  CarvedCell halves[2];
  cutter_.cut(cell.body, Eigen::Vector3d::Unit(axis), cell.body.middle()[axis], &halves[0].body,
              &halves[1].body);
  allowSlivers(cell.body, 1);
  for (CarvedCell& half : halves) {
    if (half.body.empty()) continue;
    half.mass = openMass(half.body, cell.mass.upper);
    half.list = list;
    half.layers = cell.layers;
    half.rim = cell.rim;
    push(std::move(half));
  }
}

}  // namespace fcl_prob::detail
