// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/piece_cutting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "cobstacle/cut_polytope.h"
#include "decomposition/cut_search.h"
#include "decomposition/hull_volume.h"
#include "geometry/closed_mesh.h"

namespace fcl_prob::detail {
namespace {

/// What of the mesh is in a convex cell.
struct Piece {
  SurfacePiece surface;
  CutPolytope cell;
  BestCut cut;
};

class Cutting {
 public:
  explicit Cutting(const TriangleMesh& mesh) {
    MeshView view;
    view.vertices = mesh.vertices.data();
    view.vertex_count = static_cast<int>(mesh.vertices.size());
    view.triangles = mesh.triangles.data();
    view.triangle_count = static_cast<int>(mesh.triangles.size());
    if (!opennessOf(view)) solid_.emplace(view, "mesh");
    Eigen::AlignedBox3d box;
    for (const fcl::Vector3d& v : mesh.vertices) box.extend(v);
    FaceSet faces;
    setToBox(box.min(), box.max(), faces);
    add(SurfacePiece(mesh), CutPolytope(faces));
  }

  std::size_t count() const { return pieces_.size(); }

  /// False if no cut helps.
  bool cutOnce() {
    const auto less = [](const Piece& p, const Piece& q) { return p.cut.gain < q.cut.gain; };
    const auto position = std::max_element(pieces_.begin(), pieces_.end(), less);
    if (!(position->cut.gain > 0.0)) return false;
    const Piece whole = std::move(*position);
    pieces_.erase(position);
    for (const CutPlane& side : {whole.cut.plane, whole.cut.plane.flipped()}) {
      CutPolytope cell = whole.cell;
      cell.cut(side.normal, side.offset);
      add(whole.surface.below(side, side.normal == whole.cut.plane.normal), std::move(cell));
    }
    return true;
  }

  std::vector<PointSet> points() {
    std::vector<PointSet> result;
    for (Piece& piece : pieces_) {
      result.push_back(piece.surface.vertices());
      if (solid_) addCornersInside(piece.cell, result.back());
    }
    return result;
  }

 private:
  void add(SurfacePiece surface, CutPolytope cell) {
    if (surface.isEmpty()) return;
    pieces_.push_back({std::move(surface), std::move(cell), {}});
    pieces_.back().cut = bestCut(pieces_.back().surface);
  }

  /// What of the solid is in a cell has no other extreme points than those of its surface there and
  /// corners of the cell inside it.
  void addCornersInside(CutPolytope& cell, PointSet& points) const {
    FaceSet faces;
    cell.writeTo(faces);
    for (const Eigen::Vector3d& corner : faces.vertices()) {
      if (solid_->contains(corner) == Containment::inside) points.push_back(corner);
    }
  }

  std::optional<ClosedMesh> solid_;
  std::vector<Piece> pieces_;
};

/// The corners of the hull; all points if it has no volume.
PointSet cornersOf(const PointSet& points) {
  const ConvexPolytope hull = convexHull(points);
  return hull.faces.empty() ? points : hull.vertices;
}

PointSet together(const PointSet& a, const PointSet& b) {
  PointSet all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

/// What every two of some sets would exceed.
class Unions {
 public:
  explicit Unions(std::vector<PointSet>& sets) : sets_(sets) {
    for (const PointSet& set : sets) volumes_.push_back(hullVolume(set));
    for (std::size_t i = 0; i < sets.size(); ++i) excess_.push_back(excessOf(i));
  }

  struct Choice {
    std::size_t a = 0;
    std::size_t b = 0;
    double excess = std::numeric_limits<double>::infinity();
  };

  Choice least() const {
    Choice best;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (excess_[i][j] < best.excess) best = {j, i, excess_[i][j]};
      }
    }
    return best;
  }

  /// The second set becomes part of the first, and the last set takes its place.
  void unite(const Choice& choice) {
    sets_[choice.a] = cornersOf(together(sets_[choice.a], sets_[choice.b]));
    volumes_[choice.a] = hullVolume(sets_[choice.a]);
    const std::size_t last = sets_.size() - 1;
    if (choice.b != last) {
      sets_[choice.b] = std::move(sets_[last]);
      volumes_[choice.b] = volumes_[last];
      for (std::size_t j = 0; j < choice.b; ++j) excess_[choice.b][j] = excess_[last][j];
      for (std::size_t i = choice.b + 1; i < last; ++i) excess_[i][choice.b] = excess_[last][i];
    }
    sets_.pop_back();
    volumes_.pop_back();
    excess_.pop_back();
    excess_[choice.a] = excessOf(choice.a);
    for (std::size_t i = choice.a + 1; i < sets_.size(); ++i) {
      excess_[i][choice.a] = excess(i, choice.a);
    }
  }

 private:
  double excess(std::size_t i, std::size_t j) const {
    return hullVolume(together(sets_[i], sets_[j])) - volumes_[i] - volumes_[j];
  }

  std::vector<double> excessOf(std::size_t i) const {
    std::vector<double> row;
    for (std::size_t j = 0; j < i; ++j) row.push_back(excess(i, j));
    return row;
  }

  std::vector<PointSet>& sets_;
  std::vector<double> volumes_;
  std::vector<std::vector<double>> excess_;  // of every set with those before it
};

}  // namespace

std::vector<PointSet> cutIntoPieces(const TriangleMesh& mesh, std::size_t count) {
  Cutting cutting(mesh);
  while (cutting.count() < count && cutting.cutOnce()) {
  }
  std::vector<PointSet> pieces = cutting.points();
  for (PointSet& piece : pieces) piece = cornersOf(piece);
  return pieces;
}

void unitePieces(std::size_t count, double excess, std::vector<PointSet>& pieces) {
  Unions unions(pieces);
  while (pieces.size() > 1) {
    const Unions::Choice least = unions.least();
    if (pieces.size() <= count && least.excess > excess) return;
    unions.unite(least);
  }
}

std::vector<std::pair<std::size_t, std::size_t>> unionOrder(std::vector<PointSet> pieces) {
  std::vector<std::size_t> numbers(pieces.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  std::vector<std::pair<std::size_t, std::size_t>> order;
  std::size_t next = pieces.size();
  for (Unions unions(pieces); pieces.size() > 1;) {
    const Unions::Choice least = unions.least();
    order.emplace_back(numbers[least.a], numbers[least.b]);
    numbers[least.a] = next++;
    numbers[least.b] = numbers.back();
    numbers.pop_back();
    unions.unite(least);
  }
  return order;
}

}  // namespace fcl_prob::detail
