// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/obstacle_table.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "convex/slab_polytope.h"
#include "convex/support_obstacle.h"
#include "scene/band_margin.h"
#include "scene/piece_slabs.h"
#include "scene/turning_margin.h"

namespace fcl_prob::detail {

namespace {

/// A few slabs that contain V, as many as possible along flat sides of it. Their margins have no
/// end: they say nothing of what is inside V.
PieceSlabs supportSlabs(const SupportObstacle& obstacle);

// The directions of a 26-DOP in the frame in which the obstacle is about as wide in every
// direction, and the normals of flat sides.
std::vector<Eigen::Vector3d> slabNormals(const SupportObstacle& obstacle) {
  std::vector<Eigen::Vector3d> normals = obstacle.sideNormals();
  const Eigen::Matrix3d spread = obstacle.spread();
  const double floor = 1e-12 * spread.trace();
  const Eigen::LLT<Eigen::Matrix3d> factor(spread + floor * Eigen::Matrix3d::Identity());
  for (const Eigen::Vector3d& direction : dopDirections()) {
    const Eigen::Vector3d normal = factor.matrixU().solve(direction);
    normals.push_back(normal.stableNormalized());
  }
  return normals;
}

PieceSlabs supportSlabs(const SupportObstacle& obstacle) {
  const std::vector<Eigen::Vector3d> normals = slabNormals(obstacle);
  const int used = static_cast<int>(normals.size());
  PieceSlabs slabs;
  slabs.count = (used + 3) / 4 * 4;
  slabs.data.assign(static_cast<std::size_t>(slabs.count) * kSlabFields, 0.0);
  double* out = slabs.data.data();
  for (int i = 0; i < slabs.count; ++i) {
    const bool known = i < used && normals[i].allFinite();
    if (known) {
      for (int k = 0; k < 3; ++k) out[k * slabs.count + i] = normals[i][k];
    }
    out[3 * slabs.count + i] = known ? -obstacle.supportUpper(-normals[i]) : -kUnbounded;
    out[4 * slabs.count + i] = known ? obstacle.supportUpper(normals[i]) : kUnbounded;
  }
  out[5 * slabs.count] = 4 * kUnbounded;
  return slabs;
}

constexpr std::size_t kBlockDoubles = 1 << 16;

// With more slabs than this two polytopes are quicker examined by their support functions.
constexpr std::size_t kMostSlabs = 128;

// Planes on the sides of two triangles, and lanes to fill up; a slab that bounds nothing.
constexpr int kSideSlabs = 8;
constexpr double kNoSlab[kSlabFields] = {0.0, 0.0, 0.0, -kUnbounded, kUnbounded, 0.0};

// Of slabs across the normal of a face: at less rounding may no longer be relative, from the most
// on the products of a normal and a corner, 1e14 times as large, may overflow.
constexpr double kLeastPadding = 1e-300;
constexpr double kMostPadding = 1e280;

bool isTriangle(const WhitenedTree& tree, int node) {
  return tree.tree->isTriangle(tree.tree->nodes[node].piece);
}

const ConvexPiece& shapeOf(const WhitenedTree& tree, int body) {
  return tree.shapes[tree.tree->bodies[body].shape];
}

SupportBody bodyAt(const WhitenedTree& tree, int node) {
  const int piece = tree.tree->nodes[node].piece;
  if (!tree.tree->isTriangle(piece)) {
    const int body = tree.tree->bodyOf(piece);
    return {shapeOf(tree, body).body, tree.positions[body]};
  }
  const Eigen::Vector3i& t = tree.tree->triangles[piece];
  return {tree.vertices[t[0]], tree.vertices[t[1]], tree.vertices[t[2]]};
}

// A corner a column.
Eigen::Matrix3d cornersOf(const WhitenedTree& whitened, int leaf) {
  const Eigen::Vector3i& t = whitened.tree->triangles[whitened.tree->nodes[leaf].piece];
  Eigen::Matrix3d corners;
  corners << whitened.vertices[t[0]], whitened.vertices[t[1]], whitened.vertices[t[2]];
  return corners;
}

Eigen::Vector3d normalOf(const Eigen::Matrix3d& corners) {
  const Eigen::Vector3d first = corners.col(1) - corners.col(0);
  return first.cross(corners.col(2) - corners.col(0));
}

// In the plane of a triangle, across one of its edges; 0 if it has none.
Eigen::Vector3d sideNormalOf(const Eigen::Matrix3d& corners, int edge) {
  const Eigen::Vector3d along = corners.col((edge + 1) % 3) - corners.col(edge);
  const Eigen::Vector3d across = normalOf(corners).normalized().cross(along.normalized());
  return across.allFinite() && across.norm() > 0.5 ? across.normalized()
                                                   : Eigen::Vector3d::Zero().eval();
}

Eigen::Vector3d largestCoordinates(const NodeBox& box) {
  Eigen::Vector3d largest;
  for (int k = 0; k < 3; ++k) largest[k] = std::max(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
  return largest;
}

}  // namespace

ObstacleTable::ObstacleTable(const WhitenedPair& pair) : pair_(pair) {}

std::unique_lock<std::mutex> ObstacleTable::lock(std::mutex& mutex) const {
  return shared_ ? std::unique_lock(mutex) : std::unique_lock(mutex, std::defer_lock);
}

double* ObstacleTable::allocate(int count) {
  const auto locked = lock(blocks_mutex_);
  const std::size_t needed = static_cast<std::size_t>(count) * kSlabFields;
  if (needed > block_left_) {
    block_left_ = std::max(kBlockDoubles, needed);
    blocks_.emplace_back(block_left_, boost::container::default_init);
    block_end_ = blocks_.back().data() + block_left_;
  }
  double* data = block_end_ - block_left_;
  block_left_ -= needed;
  doubles_used_ += needed;
  return data;
}

// What is added stays where it is, so that others may be read at the same time.
int ObstacleTable::add(const SlabArrays& slabs) {
  return static_cast<int>(obstacles_.push_back(slabs) - obstacles_.begin());
}

int ObstacleTable::find(NodePair leaves) {
  const std::uint64_t key =
      (static_cast<std::uint64_t>(leaves.a) << 32) | static_cast<std::uint32_t>(leaves.b);
  const std::size_t hash = PairHash()(key);
  // Bits that the places within a part do not depend on before it is large.
  Part& part = parts_[(hash >> 28) % parts_.size()];
  const auto locked = lock(part.mutex);
  const auto [entry, is_new] = part.index.try_emplace(key, -1);
  if (is_new) {
    entry.value() = add(!areTriangles(leaves) ? buildPieces(leaves)
                        : pair_.turning       ? buildTurning(leaves)
                                              : buildTriangles(leaves, allocate(kTriangleSlabs)));
  }
  return entry.value();
}

FrontPair ObstacleTable::frontPair(NodePair nodes) {
  return areLeaves(pair_, nodes) ? FrontPair::ofLeaves(nodes, find(nodes))
                                 : FrontPair::ofNodes(nodes);
}

SlabArrays ObstacleTable::slabsOnce(NodePair leaves, TriangleSlabsData& data) {
  return areTriangles(leaves) ? buildTriangles(leaves, data.data()) : slabs(find(leaves));
}

bool ObstacleTable::areTriangles(NodePair leaves) const {
  return isTriangle(pair_.a, leaves.a) && isTriangle(pair_.b, leaves.b);
}

int ObstacleTable::addLayer(const Eigen::Vector3d& m, double from, double to) {
  constexpr int kLanes = 4;
  const double padding = 32 * kEpsilon * kReach;
  double* data = allocate(kLanes);
  std::fill_n(data, kSlabFields * kLanes, 0.0);
  for (int k = 0; k < 3; ++k) data[k * kLanes] = m[k];
  for (int lane = 0; lane < kLanes; ++lane) {
    data[3 * kLanes + lane] = -kUnbounded;
    data[4 * kLanes + lane] = kUnbounded;
  }
  if (from > -kUnbounded) data[3 * kLanes] = from - padding;
  if (to < kUnbounded) data[4 * kLanes] = to + padding;
  data[5 * kLanes] = 2 * padding;
  return add({data, kLanes});
}

SlabArrays ObstacleTable::buildTriangles(NodePair leaves, double* data) const {
  const Eigen::Matrix3d a = cornersOf(pair_.a, leaves.a);
  const Eigen::Matrix3d b = cornersOf(pair_.b, leaves.b);
  const Eigen::Vector3d error =
      pair_.turning ? Eigen::Vector3d(pair_.a.error + pair_.b.error) : slabError(pair_, leaves);
  slabKernels().triangleSlabs(a.data(), b.data(), error.data(), data);
  if (pair_.turning) pair_.turning->widen(data, kTriangleSlabs, leaves);
  if (pair_.band) pair_.band->widen(data, kTriangleSlabs, leaves);
  return {data, kTriangleSlabs};
}

// Between two nearly parallel triangles all facets' normals are nearly parallel, too: planes moved
// outwards meet far beside the triangles. Slabs across the sides of either bound that. They are no
// facets, so that the inside has no need of them: their margins leave it as it is.
SlabArrays ObstacleTable::buildTurning(NodePair leaves) {
  TriangleSlabsData facets;
  buildTriangles(leaves, facets.data());
  constexpr int kCount = kTriangleSlabs + kSideSlabs;
  double* data = allocate(kCount);
  for (int field = 0; field < kSlabFields; ++field) {
    std::copy_n(&facets[field * kTriangleSlabs], kTriangleSlabs, data + field * kCount);
  }
  const Eigen::Matrix3d corners[2] = {cornersOf(pair_.a, leaves.a), cornersOf(pair_.b, leaves.b)};
  const Eigen::Vector3d error = paddingOf(leaves, pair_.a.error + pair_.b.error);
  for (int i = 0; i < kSideSlabs; ++i) {
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    if (i < 6) n = sideNormalOf(corners[i / 3], i % 3);
    const double padding = n.cwiseAbs().dot(error);
    const Eigen::RowVector3d along_a = n.transpose() * corners[0];
    const Eigen::RowVector3d along_b = n.transpose() * corners[1];
    const double moved = padding + pair_.turning->along(n, leaves);
    const double values[kSlabFields] = {n[0],
                                        n[1],
                                        n[2],
                                        along_b.minCoeff() - along_a.maxCoeff() - moved,
                                        along_b.maxCoeff() - along_a.minCoeff() + moved,
                                        -kUnbounded};
    const bool bounds = !n.isZero(0.0) && std::isfinite(values[4] - values[3]);
    for (int field = 0; field < kSlabFields; ++field) {
      data[field * kCount + kTriangleSlabs + i] = bounds ? values[field] : kNoSlab[field];
    }
  }
  return {data, kCount};
}

SlabArrays ObstacleTable::buildPieces(NodePair leaves) {
  const bool few = hasFewSlabs(leaves);
  const PieceSlabs slabs = few ? pieceSlabs(pair_, leaves) : supportSlabs(support(leaves));
  double* data = allocate(slabs.count);
  std::copy(slabs.data.begin(), slabs.data.end(), data);
  if (pair_.band) pair_.band->widen(data, slabs.count, leaves);
  return {data, slabs.count, !few};
}

bool ObstacleTable::hasFewSlabs(NodePair leaves) const {
  struct Counts {
    std::size_t faces = 1;
    std::size_t edges = 3;
    bool curved = false;
  };
  const auto count = [](const WhitenedTree& tree, int node) -> Counts {
    if (isTriangle(tree, node)) return {};
    const ConvexPiece& shape = shapeOf(tree, tree.tree->bodyOf(tree.tree->nodes[node].piece));
    return {shape.faces.size(), shape.edges.size(), shape.body.curved()};
  };
  const Counts of_a = count(pair_.a, leaves.a);
  const Counts of_b = count(pair_.b, leaves.b);
  if (of_a.curved || of_b.curved) return false;
  return of_a.faces + of_b.faces + of_a.edges * of_b.edges <= kMostSlabs;
}

// Bound on the error of b - a, axis by axis, and on the rounding of sums of such terms.
Eigen::Vector3d ObstacleTable::errorOf(NodePair leaves) const {
  return paddingOf(leaves, slabError(pair_, leaves));
}

// Four errors: of the two points of a support value and of two differences of vertices in a normal.
// The sums themselves are rounded by less than 32 ε of the reach. All of it axis by axis.
Eigen::Vector3d ObstacleTable::paddingOf(NodePair leaves, const Eigen::Vector3d& error) const {
  const Eigen::Vector3d reach = largestCoordinates(pair_.a.boxOf(leaves.a)) +
                                largestCoordinates(pair_.b.boxOf(leaves.b)) +
                                Eigen::Vector3d::Constant(kReach);
  return 4 * error + 32 * kEpsilon * reach;
}

SupportObstacle ObstacleTable::support(NodePair leaves) const {
  return {bodyAt(pair_.a, leaves.a), bodyAt(pair_.b, leaves.b), errorOf(leaves)};
}

// However a normal was rounded, V lies between its extreme values along it.
FaceSlabs ObstacleTable::faceSlabs(NodePair leaves) const {
  const Eigen::Matrix3d a = cornersOf(pair_.a, leaves.a);
  const Eigen::Matrix3d b = cornersOf(pair_.b, leaves.b);
  const Eigen::Vector3d error = errorOf(leaves);
  FaceSlabs slabs;
  slabs.n = {normalOf(a), normalOf(b)};
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector3d& n = slabs.n[i];
    const double padding = n.cwiseAbs().dot(error) + kLeastPadding;
    if (!(padding < kMostPadding)) {
      slabs.lo[i] = -kInfinity;
      slabs.hi[i] = kInfinity;
      continue;
    }
    const Eigen::RowVector3d along_a = n.transpose() * a;
    const Eigen::RowVector3d along_b = n.transpose() * b;
    slabs.lo[i] = along_b.minCoeff() - along_a.maxCoeff() - padding;
    slabs.hi[i] = along_b.maxCoeff() - along_a.minCoeff() + padding;
  }
  return slabs;
}

std::size_t ObstacleTable::pairCount() const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.index.size();
  return count;
}

// How many places a map has, and what is left of a block, depends on the order of what is added.
std::size_t ObstacleTable::memory() const {
  constexpr std::size_t kEntryBytes = 3 * sizeof(std::uint64_t);
  constexpr std::size_t kPlacesOfEntry = 3;
  const std::size_t blocks = (doubles_used_ + kBlockDoubles - 1) / kBlockDoubles;
  return obstacles_.size() * sizeof(SlabArrays) + pairCount() * kPlacesOfEntry * kEntryBytes +
         blocks * kBlockDoubles * sizeof(double);
}

}  // namespace fcl_prob::detail
