// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "part.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace oracle {

namespace {

struct Triangles {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

template <typename BV>
bool readModel(const fcl::CollisionGeometryd& geometry, Triangles& result) {
  const auto* model = dynamic_cast<const fcl::BVHModel<BV>*>(&geometry);
  if (!model) return false;
  result.vertices.assign(model->vertices, model->vertices + model->num_vertices);
  for (int i = 0; i < model->num_tris; ++i) {
    const fcl::Triangle& t = model->tri_indices[i];
    result.triangles.push_back(
        {static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
  }
  return true;
}

template <typename... BVs>
bool readAnyModel(const fcl::CollisionGeometryd& geometry, Triangles& result) {
  return (readModel<BVs>(geometry, result) || ...);
}

bool readTriangles(const fcl::CollisionGeometryd& geometry, Triangles& result) {
  return readAnyModel<fcl::AABBd, fcl::OBBd, fcl::RSSd, fcl::kIOSd, fcl::OBBRSSd, fcl::KDOPd<16>,
                      fcl::KDOPd<18>, fcl::KDOPd<24>>(geometry, result);
}

// The representative of each set of indices that `join` was called for.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      int& up = parent_[static_cast<std::size_t>(i)];
      up = parent_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }
  void join(int i, int j) { parent_[static_cast<std::size_t>(find(i))] = find(j); }

 private:
  std::vector<int> parent_;
};

}  // namespace

Part::Part(const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose, Contact contact)
    : geometry_(&geometry), linear_(pose.linear()), translation_(pose.translation()) {
  readMesh();
  if (!mesh_) readShape();
  solid_ = mesh_ && contact == Contact::solid;
  if (unbounded_) return;
  if (!curved_) placeVertices();
  connect();
  if (solid_) checkClosed();
  buildTree();
}

void Part::readMesh() {
  Triangles read;
  if (!readTriangles(*geometry_, read)) return;
  mesh_ = true;
  originals_ = std::move(read.vertices);
  for (const auto& triangle : read.triangles) {
    first_corner_.push_back(static_cast<int>(corners_.size()));
    corners_.insert(corners_.end(), triangle.begin(), triangle.end());
  }
}

void Part::readShape() {
  if (const auto* box = dynamic_cast<const fcl::Boxd*>(geometry_)) {
    addBox(-0.5 * box->side, 0.5 * box->side);
  } else if (const auto* sphere = dynamic_cast<const fcl::Sphered*>(geometry_)) {
    readCurved(CurvedShape::Kind::ellipsoid, Eigen::Vector3d::Constant(sphere->radius), 0);
  } else if (const auto* ellipsoid = dynamic_cast<const fcl::Ellipsoidd*>(geometry_)) {
    readCurved(CurvedShape::Kind::ellipsoid, ellipsoid->radii, 0);
  } else if (const auto* capsule = dynamic_cast<const fcl::Capsuled*>(geometry_)) {
    readCurved(CurvedShape::Kind::capsule, Eigen::Vector3d::Constant(capsule->radius),
               0.5 * capsule->lz);
  } else if (const auto* cone = dynamic_cast<const fcl::Coned*>(geometry_)) {
    readCurved(CurvedShape::Kind::cone, Eigen::Vector3d::Constant(cone->radius), 0.5 * cone->lz);
  } else if (const auto* cylinder = dynamic_cast<const fcl::Cylinderd*>(geometry_)) {
    readCurved(CurvedShape::Kind::cylinder, Eigen::Vector3d::Constant(cylinder->radius),
               0.5 * cylinder->lz);
  } else if (const auto* convex = dynamic_cast<const fcl::Convexd*>(geometry_)) {
    addHull(convex->getVertices());
  } else if (const auto* triangle = dynamic_cast<const fcl::TrianglePd*>(geometry_)) {
    addHull({triangle->a, triangle->b, triangle->c});
  } else if (const auto* half_space = dynamic_cast<const fcl::Halfspaced*>(geometry_)) {
    placeUnbounded(half_space->n, half_space->d, false);
  } else if (const auto* plane = dynamic_cast<const fcl::Planed*>(geometry_)) {
    placeUnbounded(plane->n, plane->d, true);
  } else if (const auto* octree = dynamic_cast<const fcl::OcTreed*>(geometry_)) {
    octree_ = octree;
    if (octree->getRoot()) addCells(octree->getRoot(), octree->getRootBV());
  } else {
    throw std::invalid_argument("no geometry that the oracle knows");
  }
}

void Part::addHull(const std::vector<Eigen::Vector3d>& corners) {
  first_corner_.push_back(static_cast<int>(corners_.size()));
  for (const Eigen::Vector3d& corner : corners) {
    corners_.push_back(static_cast<int>(originals_.size()));
    originals_.push_back(corner);
  }
}

void Part::addBox(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]);
  }
  addHull(corners);
}

// The occupied cells without children that fcl::collide reaches: it passes over what is free or
// uncertain.
void Part::addCells(const fcl::OcTreed::OcTreeNode* node, const fcl::AABBd& box) {
  if (!octree_->isNodeOccupied(node)) return;
  if (!octree_->nodeHasChildren(node)) return addBox(box.min_, box.max_);
  if (octree_->isNodeFree(node)) return;
  for (unsigned int i = 0; i < 8; ++i) {
    if (!octree_->nodeChildExists(node, i)) continue;
    fcl::AABBd child;
    fcl::computeChildBV(box, i, child);
    addCells(octree_->getNodeChild(node, i), child);
  }
}

void Part::readCurved(CurvedShape::Kind kind, const Eigen::Vector3d& radii, double half_length) {
  curved_ = true;
  shape_.kind = kind;
  shape_.radii = radii.cast<Long>();
  shape_.half_length = half_length;
  shape_.linear = linear_.cast<Long>();
  reference_ = converted<Wide>(translation_);
  extent_ = shape_.magnitude();
  error_ = std::ldexp(1.0L, -58) * extent_;
  wide_error_ = ldexp(Wide(extent_.maxCoeff()) + Wide(translation_.cwiseAbs().maxCoeff()), -225);
}

void Part::placeUnbounded(const Eigen::Vector3d& normal, double offset, bool surface) {
  unbounded_ = true;
  half_space_.exact_normal = product(linear_, converted<Rational>(normal));
  half_space_.exact_offset =
      Rational(offset) + dot(half_space_.exact_normal, converted<Rational>(translation_));
  half_space_.normal = toWide(half_space_.exact_normal);
  half_space_.offset = Wide(half_space_.exact_offset);
  half_space_.surface = surface;
}

// Vertices become relative to the middle of them all; what is rounded away of 237 bits is far
// below what is rounded away of 64, unless poses are that many times larger than the part.
void Part::placeVertices() {
  first_corner_.push_back(static_cast<int>(corners_.size()));
  if (originals_.empty()) return;
  const WideVector translation = converted<Wide>(translation_);
  std::vector<WideVector> placed;
  for (const Eigen::Vector3d& v : originals_) {
    placed.push_back(product(linear_, converted<Wide>(v)) + translation);
  }
  WideVector lo = placed[0], hi = placed[0];
  Wide largest = 0;
  for (const WideVector& v : placed) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], v[k]);
      hi[k] = std::max(hi[k], v[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    reference_[k] = (lo[k] + hi[k]) / 2;
    largest = std::max(largest, Wide(abs(lo[k]) + abs(hi[k])));
  }
  Long farthest = translation_.cast<Long>().cwiseAbs().maxCoeff();
  for (const Eigen::Vector3d& v : originals_) {
    farthest = std::max(farthest, 4 * v.cast<Long>().cwiseAbs().maxCoeff());
  }
  for (const WideVector& v : placed) {
    vertices_.push_back(toLong(v - reference_));
    extent_ = extent_.cwiseMax(vertices_.back().cwiseAbs());
  }
  error_ = std::ldexp(1.0L, -63) * extent_ +
           LongVector::Constant(std::ldexp(farthest + largest.convert_to<Long>(), -220));
  wide_error_ = ldexp(Wide(farthest) + largest, -225);
}

// One vertex of all that hangs together by vertices of equal coordinates.
void Part::connect() {
  struct Less {
    bool operator()(const Eigen::Vector3d& u, const Eigen::Vector3d& v) const {
      return std::lexicographical_compare(u.data(), u.data() + 3, v.data(), v.data() + 3);
    }
  };
  std::map<Eigen::Vector3d, int, Less> known;
  for (std::size_t i = 0; i < originals_.size(); ++i) {
    welded_.push_back(known.emplace(originals_[i], static_cast<int>(i)).first->second);
  }
  Sets sets(originals_.size());
  for (std::size_t piece = 0; piece + 1 < first_corner_.size(); ++piece) {
    const auto first = static_cast<std::size_t>(first_corner_[piece]);
    const auto last = static_cast<std::size_t>(first_corner_[piece + 1]);
    for (std::size_t i = first; i < last; ++i) {
      sets.join(welded_[static_cast<std::size_t>(corners_[first])],
                welded_[static_cast<std::size_t>(corners_[i])]);
    }
  }
  std::vector<bool> seen(originals_.size());
  for (int corner : corners_) {
    const auto set = static_cast<std::size_t>(sets.find(welded_[static_cast<std::size_t>(corner)]));
    if (!seen[set]) representatives_.push_back(corner);
    seen[set] = true;
  }
}

// Every edge is walked as often one way as the other: then the number of times that a closed path
// of the surface winds around a point is the same along all rays.
void Part::checkClosed() const {
  std::map<std::pair<int, int>, int> walked;
  for (int i = 0; i < pieceCount(); ++i) {
    const int* t = triangle(i);
    for (int k = 0; k < 3; ++k) {
      const int from = welded_[static_cast<std::size_t>(t[k])];
      const int to = welded_[static_cast<std::size_t>(t[(k + 1) % 3])];
      if (from < to) ++walked[{from, to}];
      if (from > to) --walked[{to, from}];
    }
  }
  for (const auto& [edge, times] : walked) {
    if (times != 0) {
      throw std::invalid_argument("a surface that does not close bounds no solid: edge " +
                                  std::to_string(edge.first) + " " + std::to_string(edge.second));
    }
  }
}

bool Part::hasEqualCorners(int i) const {
  const auto corner = [&](int k) { return welded_[static_cast<std::size_t>(triangle(i)[k])]; };
  return corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0);
}

bool Part::isOccupied() const { return octree_ || geometry_->isOccupied(); }

bool Part::isDividedOctree() const {
  return octree_ && octree_->getRoot() && octree_->nodeHasChildren(octree_->getRoot());
}

int Part::pieceCount() const { return curved_ ? 1 : static_cast<int>(first_corner_.size()) - 1; }

ConvexSet Part::piece(int i) const {
  ConvexSet set;
  if (curved_) {
    set.curved = &shape_;
    return set;
  }
  const auto index = static_cast<std::size_t>(i);
  set.vertices = vertices_.data();
  set.corners = &corners_[static_cast<std::size_t>(first_corner_[index])];
  set.count = first_corner_[index + 1] - first_corner_[index];
  return set;
}

ExactVector Part::exactVertex(int i) const {
  if (curved_) return converted<Rational>(translation_);
  return product(linear_, converted<Rational>(originals_[static_cast<std::size_t>(i)])) +
         converted<Rational>(translation_);
}

WideVector Part::wideCorner(int piece, int corner) const {
  const int index =
      corners_[static_cast<std::size_t>(first_corner_[static_cast<std::size_t>(piece)] + corner)];
  return product(linear_, converted<Wide>(originals_[static_cast<std::size_t>(index)])) +
         converted<Wide>(translation_) - reference_;
}

ExactVector Part::exactCorner(int piece, int corner) const {
  return exactVertex(
      corners_[static_cast<std::size_t>(first_corner_[static_cast<std::size_t>(piece)] + corner)]);
}

void Part::buildTree() {
  std::vector<PieceBox> boxes;
  std::vector<int> order;
  for (int i = 0; i < pieceCount(); ++i) {
    order.push_back(i);
    if (curved_) {
      boxes.push_back({-extent_, extent_});
      continue;
    }
    const ConvexSet set = piece(i);
    PieceBox box{set.corner(0), set.corner(0)};
    for (int corner = 1; corner < set.count; ++corner) {
      box.lo = box.lo.cwiseMin(set.corner(corner));
      box.hi = box.hi.cwiseMax(set.corner(corner));
    }
    boxes.push_back(box);
  }
  if (!order.empty()) buildNode(order, 0, static_cast<int>(order.size()), boxes);
}

// Halves at the median of the longest side of the middles.
int Part::buildNode(std::vector<int>& order, int begin, int end,
                    const std::vector<PieceBox>& boxes) {
  const auto boxOf = [&](int i) -> const PieceBox& { return boxes[static_cast<std::size_t>(i)]; };
  const int index = static_cast<int>(nodes_.size());
  PieceNode node;
  node.box = boxOf(order[static_cast<std::size_t>(begin)]);
  LongVector least = node.box.lo + node.box.hi, most = least;
  for (int i = begin; i < end; ++i) {
    const PieceBox& box = boxOf(order[static_cast<std::size_t>(i)]);
    node.box.lo = node.box.lo.cwiseMin(box.lo);
    node.box.hi = node.box.hi.cwiseMax(box.hi);
    least = least.cwiseMin(box.lo + box.hi);
    most = most.cwiseMax(box.lo + box.hi);
  }
  nodes_.push_back(node);
  if (end - begin == 1) {
    nodes_.back().piece = order[static_cast<std::size_t>(begin)];
    return index;
  }
  int axis = 0;
  (most - least).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(
      order.begin() + begin, order.begin() + middle, order.begin() + end, [&](int i, int j) {
        return boxOf(i).lo[axis] + boxOf(i).hi[axis] < boxOf(j).lo[axis] + boxOf(j).hi[axis];
      });
  const int left = buildNode(order, begin, middle, boxes);
  const int right = buildNode(order, middle, end, boxes);
  nodes_[static_cast<std::size_t>(index)].left = left;
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

}  // namespace oracle
