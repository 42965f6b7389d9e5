// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/mesh_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <numeric>
#include <utility>

#include "base/keep_once.h"
#include "fcl_prob/exceptions.h"
#include "geometry/closed_mesh.h"
#include "geometry/surface_caps.h"
#include "scene/coplanar_triangles.h"
#include "scene/mesh_reach.h"

namespace fcl_prob::detail {
namespace {

// Triangles and polygons of a patch. Beside an arm of 2,000 triangles 16 and 64 took the same time,
// 16 being found sooner.
constexpr std::size_t kMostOfPatch = 16;

// A patch is convex if none of its corners is farther beyond one of its planes, as a share of the
// size of the mesh.
constexpr double kConvexPatch = 1e-12;

// Of K nothing is known within this share of it, at the most.
constexpr double kDeepest = 1e-7;

// Polygons of more corners are in no patch, and no patch has more than twice as many.
constexpr std::size_t kMostCornersOfPatch = 48;

// Of the triangles of a polygon that is not folded the areas as vectors add up to as much.
constexpr double kUnfolded = 0.999;

/// Of pieces: the triangles of a mesh, and behind them polygons that some of them are in.
class MeshPatchSearch {
 public:
  MeshPatchSearch(const TriangleMesh& mesh, const MeshView& view, const WeldedSurface& surface,
                  const std::vector<FlatPolygon>& polygons)
      : mesh_(mesh), polygons_(polygons), surrounding_(view, surface, mesh.vertices, {0, 0, 0}) {
    corners_.reserve(mesh.triangles.size());
    normals_.reserve(mesh.triangles.size() + polygons.size());
    areas_.reserve(mesh.triangles.size() + polygons.size());
    for (const Eigen::Vector3d& v : mesh.vertices) size_ = std::max(size_, v.norm());
    for (int t = 0; t < triangleCount(); ++t) {
      const std::array<int, 3> corners = weldedCorners(surface.welded, mesh_.triangles[t]);
      corners_.push_back(corners);
      const Eigen::Vector3d first = at(corners[1]) - at(corners[0]);
      normals_.emplace_back(first.cross(at(corners[2]) - at(corners[0])));
      areas_.push_back(normals_.back().norm());
      if (areas_.back() > 0.0) normals_.back() /= areas_.back();
    }
    held_.assign(mesh.triangles.size() + polygons.size(), false);
    piece_of_.resize(mesh.triangles.size());
    std::iota(piece_of_.begin(), piece_of_.end(), 0);
    for (const FlatPolygon& polygon : polygons) addPolygon(polygon);
    findNeighbours(surface.pairing);
  }

  /// Large ones first: around them patches are largest.
  std::vector<MeshPatch> run() {
    std::vector<int> order(held_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [this](int x, int y) {
      return areas_[x] != areas_[y] ? areas_[x] > areas_[y] : x < y;
    });
    std::vector<MeshPatch> patches;
    for (const int piece : order) {
      if (held_[piece] || !(areas_[piece] > 0.0)) continue;
      MeshPatch patch = largestOf(around(piece));
      for (const int each : patch.pieces) held_[each] = true;
      if (!patch.pieces.empty()) patches.push_back(std::move(patch));
    }
    return patches;
  }

  const ClosedMesh& solid() const { return surrounding_.solid(); }

 private:
  int triangleCount() const { return static_cast<int>(mesh_.triangles.size()); }
  const Eigen::Vector3d& at(int vertex) const { return mesh_.vertices[vertex]; }

  const std::array<int, 3>& cornersOf(int t) const { return corners_[t]; }

  template <typename Function>
  void visitCorners(int piece, const Function& function) const {
    if (piece < triangleCount()) {
      for (const int v : cornersOf(piece)) function(v);
    } else {
      for (const int v : polygons_[piece - triangleCount()].corners) function(v);
    }
  }

  // Its triangles are held by it. The normal is outward as theirs is: what is folded onto itself
  // is left alone.
  void addPolygon(const FlatPolygon& polygon) {
    const auto piece = static_cast<int>(areas_.size());
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    double size = 0.0;
    for (const int t : polygon.triangles) {
      area += areas_[t] * normals_[t];
      size += areas_[t];
      held_[t] = true;
      piece_of_[t] = piece;
    }
    normals_.push_back(area.normalized());
    areas_.push_back(area.norm());
    held_[piece] =
        polygon.corners.size() > kMostCornersOfPatch || !(area.norm() > kUnfolded * size);
  }

  void findNeighbours(const EdgePairing& pairing) {
    neighbours_.resize(held_.size());
    for (const EdgeMatch& match : pairing.matches) {
      const int one = piece_of_[match.forward.polygon];
      const int other = piece_of_[match.backward.polygon];
      if (one == other) continue;
      neighbours_[one].push_back(other);
      neighbours_[other].push_back(one);
    }
  }

  bool isBehind(int piece, int plane) const {
    const Eigen::Vector3d& n = normals_[plane];
    double level = 0.0;
    bool is_first = true;
    visitCorners(plane, [&](int v) {
      if (is_first) level = n.dot(at(v)) + kConvexPatch * size_;
      is_first = false;
    });
    bool is_behind = true;
    visitCorners(piece, [&](int v) { is_behind = is_behind && n.dot(at(v)) <= level; });
    return is_behind;
  }

  // By rings, as long as all of it is on its hull (Ehmann and Lin 2001).
  std::vector<int> around(int seed) const {
    std::vector<int> patch;
    patch.reserve(kMostOfPatch);
    patch.push_back(seed);
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const int next : neighbours_[patch[i]]) {
        if (patch.size() == kMostOfPatch) return patch;
        if (held_[next] || !(areas_[next] > 0.0)) continue;
        if (std::find(patch.begin(), patch.end(), next) != patch.end()) continue;
        const auto fits = [&](int piece) { return isBehind(piece, next) && isBehind(next, piece); };
        if (std::all_of(patch.begin(), patch.end(), fits)) patch.push_back(next);
      }
    }
    return patch;
  }

  // Of the first of the pieces: all of them, or as many as halving the difference finds to have a
  // hull within the mesh. Empty if there are not even two.
  MeshPatch largestOf(const std::vector<int>& pieces) const {
    MeshPatch best;
    std::size_t most = pieces.size() + 1;
    std::size_t tried = pieces.size();
    while (tried > std::max<std::size_t>(1, best.pieces.size())) {
      MeshPatch patch = patchOf({pieces.begin(), pieces.begin() + tried});
      if (patch.pieces.empty()) {
        most = tried;
      } else {
        best = std::move(patch);
      }
      tried = (std::max<std::size_t>(1, best.pieces.size()) + most) / 2;
    }
    return best;
  }

  MeshPatch patchOf(std::vector<int> pieces) const {
    MeshPatch patch;
    patch.vertices.reserve(3 * pieces.size());
    for (const int piece : pieces) {
      visitCorners(piece, [&](int v) { patch.vertices.push_back(v); });
      if (piece >= triangleCount()) {
        patch.off = std::max(patch.off, polygons_[piece - triangleCount()].off);
      }
    }
    keepOnce(patch.vertices);
    if (patch.vertices.size() > 2 * kMostCornersOfPatch) return {};
    std::vector<Eigen::Vector3d> points;
    points.reserve(patch.vertices.size());
    for (const int v : patch.vertices) points.push_back(at(v));
    auto fan = convexFanAround(points);
    if (!fan) return {};
    patch.fan = std::move(*fan);
    if (!surrounding_.surrounds(patch.fan, {}, kDeepest)) return {};
    for (std::size_t f = 0; f < patch.fan.normals.size(); ++f) {
      if (!(patch.fan.depths[f] < kDeepest * patch.fan.offsets[f])) return {};
    }
    patch.fan.vertices = {};
    patch.pieces = std::move(pieces);
    return patch;
  }

  const TriangleMesh& mesh_;
  std::vector<std::array<int, 3>> corners_;  // welded, of triangles
  const std::vector<FlatPolygon>& polygons_;
  SurroundingMesh surrounding_;
  double size_ = 0.0;
  std::vector<Eigen::Vector3d> normals_;  // by piece
  std::vector<double> areas_;             // doubled
  std::vector<int> piece_of_;             // of every triangle
  std::vector<boost::container::small_vector<int, 3>> neighbours_;
  std::vector<bool> held_;
};

/// Halves of what has middles, down to what has a piece.
class PatchTreeBuilder {
 public:
  PatchTreeBuilder(const TriangleMesh& mesh, MeshPatches& into)
      : mesh_(mesh),
        first_polygon_(static_cast<int>(mesh.triangles.size())),
        first_patch_(first_polygon_ + static_cast<int>(into.polygons.size())),
        into_(into) {}

  void run() {
    const int count = first_patch_ + static_cast<int>(into_.patches.size());
    std::vector<bool> held(static_cast<std::size_t>(count), false);
    for (int piece = first_polygon_; piece < count; ++piece) {
      for (const int below : piecesOf(piece)) held[below] = true;
    }
    std::vector<Item> items;
    for (int piece = count; piece-- > 0;) {
      if (!held[piece]) items.push_back({middleOf(piece), piece});
    }
    into_.nodes.reserve(2 * mesh_.triangles.size());
    add(items.data(), items.data() + items.size());
  }

 private:
  struct Item {
    Eigen::Vector3d middle;
    int piece;
  };

  const std::vector<int>& piecesOf(int piece) const {
    return piece < first_patch_ ? into_.polygons[piece - first_polygon_].triangles
                                : into_.patches[piece - first_patch_].pieces;
  }

  void extend(Eigen::AlignedBox3d& box, int piece) const {
    if (piece >= first_polygon_) {
      for (const int below : piecesOf(piece)) extend(box, below);
      return;
    }
    for (int k = 0; k < 3; ++k) box.extend(mesh_.vertices[mesh_.triangles[piece][k]]);
  }

  Eigen::Vector3d middleOf(int piece) const {
    Eigen::AlignedBox3d box;
    extend(box, piece);
    return box.center();
  }

  int add(Item* first, Item* last) {
    const auto index = static_cast<int>(into_.nodes.size());
    into_.nodes.emplace_back();
    if (last - first > 1) {
      addChildren(index, first, last);
      return index;
    }
    into_.nodes[index].piece = first->piece;
    if (first->piece < first_polygon_) return index;
    std::vector<Item> below;
    below.reserve(piecesOf(first->piece).size());
    for (const int piece : piecesOf(first->piece)) below.push_back({middleOf(piece), piece});
    addChildren(index, below.data(), below.data() + below.size());
    return index;
  }

  void addChildren(int index, Item* first, Item* last) {
    Eigen::AlignedBox3d box;
    for (const Item* item = first; item != last; ++item) box.extend(item->middle);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    Item* const middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [axis](const Item& x, const Item& y) {
      return std::pair(x.middle[axis], x.piece) < std::pair(y.middle[axis], y.piece);
    });
    const int left = add(first, middle);
    const int right = add(middle, last);
    into_.nodes[index].left = left;
    into_.nodes[index].right = right;
  }

  const TriangleMesh& mesh_;
  const int first_polygon_;
  const int first_patch_;
  MeshPatches& into_;
};

// Of what is open there are only polygons.
void findPatches(const TriangleMesh& mesh, const WeldedSurface& surface, MeshPatches& into) try {
  MeshPatchSearch search(mesh, viewOf(mesh), surface, into.polygons);
  into.patches = search.run();
  if (!into.patches.empty()) into.solid = search.solid();
} catch (const OpenMesh&) {
}

std::unique_ptr<const MeshPatches> patchesIn(const TriangleMesh& mesh) {
  const WeldedSurface surface(viewOf(mesh));
  auto made = std::make_unique<MeshPatches>();
  made->polygons = flatPolygonsIn(mesh, surface.welded);
  findPatches(mesh, surface, *made);
  if (made->polygons.empty() && made->patches.empty()) return nullptr;
  PatchTreeBuilder(mesh, *made).run();
  return made;
}

}  // namespace

std::size_t MeshPatches::memory() const {
  std::size_t bytes = nodes.capacity() * sizeof(Node) + (solid ? solid->memory() : 0);
  for (const FlatPolygon& polygon : polygons) {
    bytes += sizeof(FlatPolygon) +
             (polygon.triangles.capacity() + polygon.corners.capacity()) * sizeof(int);
  }
  for (const MeshPatch& patch : patches) {
    bytes += sizeof(MeshPatch) +
             (patch.pieces.capacity() + patch.vertices.capacity()) * sizeof(int) +
             patch.fan.normals.size() * (sizeof(Eigen::Vector3d) + 2 * sizeof(double)) +
             patch.fan.arcs.size() * 2 * sizeof(int);
  }
  return bytes;
}

const MeshPatches* PatchesOfMesh::of(const std::function<TriangleMesh()>& mesh) const {
  std::call_once(once_, [&] { made_ = patchesIn(mesh()); });
  return made_.get();
}

}  // namespace fcl_prob::detail
