// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/fat_obstacles.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "gaussian/constants.h"

namespace fcl_prob::detail {
namespace {

// An edge leaning less than this against both normals of an arc counts as parallel to it.
constexpr double kParallel = 1e-8;

// Planes across an edge whose other end lies in front by less than this, relative, are kept.
constexpr double kOnPlane = 1e-9;

// The normals of a sharper edge than this, added up, are no longer than this.
constexpr double kSharpest = 1e-3;

// Beyond this share of P nothing is certified of its inside.
constexpr double kLargestShare = 1e-3;

// A triangle whose normal is known no better than this covers nothing.
constexpr double kPoorNormal = 1e-6;

constexpr double kNever = 1e300;

}  // namespace

FatObstacles::FatObstacles(const WhitenedPair& pair, const PieceTree::Part& part, bool fan_is_a,
                           const Eigen::Matrix3d& linear)
    : mesh_(fan_is_a ? pair.b : pair.a), sign_(fan_is_a ? 1.0 : -1.0), arcs_(part.fan->arcs) {
  const WhitenedTree& body = fan_is_a ? pair.a : pair.b;
  Eigen::Vector3d largest = Eigen::Vector3d::Constant(kReach);
  for (const WhitenedTree* tree : {&body, &mesh_}) {
    const NodeBox& box = tree->boxes[0];
    for (int k = 0; k < 3; ++k) {
      largest[k] += 2 * std::max(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
    }
  }
  reach_ = 2 * largest.norm();
  pad_ = 4 * (body.error + mesh_.error) + 64 * kEpsilon * largest;
  moveFan(body, part, linear);
  details_.resize(mesh_.tree->triangles.size());
  memory_ = leastMemory(details_.size());
}

// In the whitened frame a normal n of the fan has the direction m with Lᵀm ∥ n; however m was
// rounded, the offset follows from how far Lᵀm is off n.
void FatObstacles::moveFan(const WhitenedTree& body, const PieceTree::Part& part,
                           const Eigen::Matrix3d& linear) {
  const ConvexFan& fan = *part.fan;
  const int anchor = part.vertices.begin;
  centre_ = body.vertices[anchor] + linear * (fan.centre - body.tree->vertices[anchor]);
  for (int k = 0; k < 3; ++k) {
    box_.lo[k] = kInfinity;
    box_.hi[k] = -kInfinity;
  }
  for (const Eigen::Vector3d& vertex : fan.vertices) {
    points_.emplace_back(-sign_ * (linear * vertex));
    for (int k = 0; k < 3; ++k) {
      box_.lo[k] = std::min(box_.lo[k], points_.back()[k] - pad_[k]);
      box_.hi[k] = std::max(box_.hi[k], points_.back()[k] + pad_[k]);
    }
  }
  const Eigen::Matrix3d inverse = linear.inverse();
  const double size = linear.cwiseAbs().sum();
  double share = 0.0;
  for (std::size_t f = 0; f < fan.normals.size(); ++f) {
    const Eigen::Vector3d n = (inverse.transpose() * fan.normals[f]).normalized();
    const Eigen::Vector3d back = linear.transpose() * n;
    const double scale = back.dot(fan.normals[f]);
    const double off =
        (back - scale * fan.normals[f]).norm() * fan.radius + 16 * kEpsilon * size * fan.radius;
    const double offset = scale * fan.offsets[f] + off + padding(n);
    const double depth = scale * fan.depths[f] + 2 * (off + padding(n));
    usable_ = usable_ && scale > 0.0 && offset > depth && std::isfinite(offset);
    normals_.push_back(-sign_ * n);
    offsets_.push_back(offset);
    share = std::max(share, depth / offset);
  }
  // See docs/rounding.md: once for the mesh off its hull, once for the fan off the hull.
  share_ = 2.5 * share;
  usable_ = usable_ && share_ < kLargestShare;
  for (std::size_t f = 0; f < normals_.size(); ++f) {
    pads_.push_back(padding(normals_[f]));
    margins_.push_back(share_ * offsets_[f] + 3 * pads_[f]);
    most_margin_ = std::max(most_margin_, margins_[f]);
  }
}

double FatObstacles::support(const Eigen::Vector3d& n) const {
  double highest = -kInfinity;
  for (const Eigen::Vector3d& point : points_) highest = std::max(highest, n.dot(point));
  return highest + padding(n);
}

double FatObstacles::support(int triangle, const Eigen::Vector3d& n, double of_p) const {
  return of_p + (n.transpose() * corners(triangle)).maxCoeff() + padding(n);
}

Eigen::Matrix3d FatObstacles::corners(int triangle) const {
  const Eigen::Vector3i& t = mesh_.tree->triangles[triangle];
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = sign_ * (mesh_.vertices[t[k]] - centre_);
  return corners;
}

NodeBox FatObstacles::obstacleBox(int node) const {
  const NodeBox& box = mesh_.boxes[node];
  NodeBox result;
  for (int k = 0; k < 3; ++k) {
    const double lo = sign_ * ((sign_ > 0 ? box.lo[k] : box.hi[k]) - centre_[k]);
    const double hi = sign_ * ((sign_ > 0 ? box.hi[k] : box.lo[k]) - centre_[k]);
    result.lo[k] = box_.lo[k] + lo - pad_[k];
    result.hi[k] = box_.hi[k] + hi + pad_[k];
  }
  return result;
}

bool FatObstacles::isTooSmallFor(const std::vector<std::pair<int, int>>& spans) const {
  if (spans.empty()) return false;
  return std::all_of(spans.begin(), spans.end(), [this](const std::pair<int, int>& span) {
    if (span.first < 0) return false;
    const Eigen::Vector3d along = mesh_.vertices[span.second] - mesh_.vertices[span.first];
    const Eigen::Vector3d n = along.normalized();
    return n.allFinite() && n.dot(along) - 4 * padding(n) > support(n) + support(-n);
  });
}

FatObstacles::Details& FatObstacles::details(int triangle) {
  std::unique_ptr<Details>& slot = details_[triangle];
  if (!slot) {
    slot = std::make_unique<Details>();
    ++built_;
    const Eigen::Matrix3d t = corners(triangle);
    slot->offsets.resize(normals_.size());
    for (std::size_t f = 0; f < normals_.size(); ++f) {
      const Eigen::Vector3d& n = normals_[f];
      slot->offsets[f] =
          offsets_[f] + std::max({n.dot(t.col(0)), n.dot(t.col(1)), n.dot(t.col(2))});
    }
    memory_ += sizeof(Details) + slot->offsets.capacity() * sizeof(double);
  }
  return *slot;
}

const std::vector<double>& FatObstacles::faceOffsets(int triangle) {
  return details(triangle).offsets;
}

const std::vector<ObstaclePlane>& FatObstacles::otherPlanes(int triangle) {
  Details& known = details(triangle);
  if (!known.has_planes) buildPlanes(triangle, known);
  return known.planes;
}

// Its other planes must have been made: those that are left out move the others.
ObstaclePlane FatObstacles::facePlane(int triangle, int face) const {
  const Details& known = *details_[triangle];
  return {normals_[face], known.offsets[face] + pads_[face], margins_[face] + known.loss};
}

void FatObstacles::buildPlanes(int triangle, Details& into) {
  const Eigen::Matrix3d t = corners(triangle);
  into.has_planes = true;
  addTriangleNormal(t, into);
  for (int edge = 0; edge < 3; ++edge) addEdge(t, edge, into);
  failed_ = failed_ || !(into.loss < kNever);
  for (ObstaclePlane& plane : into.planes) plane.margin += into.loss;
  into.planes.shrink_to_fit();
  memory_ += into.planes.capacity() * sizeof(ObstaclePlane);
}

ObstaclePlane FatObstacles::planeAcross(const Eigen::Matrix3d& corners, const Eigen::Vector3d& n,
                                        double of_p) const {
  const double pad = padding(n);
  const double extent = (n.transpose() * corners).maxCoeff();
  return {n, of_p + extent + pad, share_ * of_p + 3 * pad};
}

void FatObstacles::addTriangleNormal(const Eigen::Matrix3d& corners, Details& into) const {
  const Eigen::Vector3d first = corners.col(1) - corners.col(0);
  const Eigen::Vector3d second = corners.col(2) - corners.col(0);
  const Eigen::Vector3d across = first.cross(second);
  const double turned = 8 * kEpsilon * first.norm() * second.norm() / across.norm();
  if (!(turned < kPoorNormal)) {
    into.loss = kNever;
    return;
  }
  for (const double side : {1.0, -1.0}) {
    const Eigen::Vector3d n = side * across.normalized();
    into.planes.push_back(planeAcross(corners, n, support(n)));
    into.planes.back().margin += turned * reach_;
  }
}

// Where the arc between the normals of two faces crosses the plane across an edge of the triangle,
// on the side away from the triangle, V has a facet.
void FatObstacles::addEdge(const Eigen::Matrix3d& corners, int edge, Details& into) {
  const Eigen::Vector3d& from = corners.col(edge);
  const Eigen::Vector3d along = corners.col((edge + 1) % 3) - from;
  const Eigen::Vector3d opposite = corners.col((edge + 2) % 3) - from;
  const double length = along.norm();
  if (!(length > 0.0)) {
    into.loss = kNever;
    return;
  }
  along_.resize(normals_.size());
  for (std::size_t f = 0; f < normals_.size(); ++f) along_[f] = normals_[f].dot(along);
  const double parallel = kParallel * length;
  for (const auto& [f, g] : arcs_) {
    const double at_f = along_[f];
    const double at_g = along_[g];
    const double lean = std::fabs(at_f) + std::fabs(at_g);
    if (lean <= parallel) {
      const double sum = (normals_[f] + normals_[g]).norm();
      const double loss = sum > kSharpest ? 8 * (lean / length) * (2 / sum) * reach_ : kNever;
      into.loss = std::max(into.loss, loss);
      continue;
    }
    if ((at_f > 0.0) == (at_g > 0.0)) continue;
    const double of_f = std::fabs(at_g);
    const double of_g = std::fabs(at_f);
    const Eigen::Vector3d crossing = of_f * normals_[f] + of_g * normals_[g];
    if (crossing.dot(opposite) > kOnPlane * crossing.norm() * opposite.norm()) continue;
    const double size = crossing.norm();
    if (!(size > kSharpest * lean)) {
      into.loss = kNever;
      continue;
    }
    const double of_p = (of_f * offsets_[f] + of_g * offsets_[g]) / size;
    ObstaclePlane plane = planeAcross(corners, crossing / size, of_p);
    const double gap = (normals_[f] - normals_[g]).norm();
    plane.margin += 64 * kEpsilon * gap * (length / lean) * (lean / size) * reach_;
    into.planes.push_back(plane);
  }
}

}  // namespace fcl_prob::detail
