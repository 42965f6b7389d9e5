// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/piece_cutting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "decomposition/cut_search.h"
#include "decomposition/hull_volume.h"
#include "geometry/closed_mesh.h"

namespace fcl_prob::detail {
namespace {

/// Of the volume of the mesh's hull: cuts that gain less are not worth a piece.
constexpr double kLeastGain = 1e-5;

/// A piece, and where it is best cut.
struct CutPiece {
  Piece piece;
  BestCut cut;
  bool looked_ahead = false;
};

class Cutting {
 public:
  explicit Cutting(const TriangleMesh& mesh) {
    const MeshView view = viewOf(mesh);
    if (!opennessOf(view)) solid_.emplace(view, "mesh");
    least_gain_ = kLeastGain * hullVolume({mesh.vertices.begin(), mesh.vertices.end()});
    add({SurfacePiece(mesh), SolidCell(mesh, solid_ ? &*solid_ : nullptr)});
  }

  std::size_t count() const { return pieces_.size(); }

  /// False if no cut helps.
  bool cutOnce() {
    auto position = mostGain();
    if (!(position->cut.gain > least_gain_)) {
      lookAhead();
      position = mostGain();
    }
    if (!(position->cut.gain > least_gain_)) return false;
    const CutPiece whole = std::move(*position);
    pieces_.erase(position);
    for (const CutPlane& side : {whole.cut.plane, whole.cut.plane.flipped()}) {
      add(whole.piece.below(side, side.normal == whole.cut.plane.normal));
    }
    return true;
  }

  std::vector<PointSet> points() const {
    std::vector<PointSet> result;
    for (const CutPiece& part : pieces_) {
      result.push_back(part.piece.surface.vertices());
      const PointSet& inside = part.piece.cell.cornersInside();
      result.back().insert(result.back().end(), inside.begin(), inside.end());
    }
    return result;
  }

 private:
  void add(Piece piece) {
    if (piece.isEmpty()) return;
    const BestCut cut = bestCut(piece);
    pieces_.push_back({std::move(piece), cut});
  }

  std::vector<CutPiece>::iterator mostGain() {
    return std::max_element(
        pieces_.begin(), pieces_.end(),
        [](const CutPiece& p, const CutPiece& q) { return p.cut.gain < q.cut.gain; });
  }

  /// Of pieces of which no single cut helps, as of a ring. (Surfaces without an inside would be cut
  /// into flat pieces: their hulls vanish, but many of them touch at once.)
  void lookAhead() {
    if (!solid_) return;
    for (CutPiece& part : pieces_) {
      if (part.looked_ahead || part.cut.gain > least_gain_) continue;
      part.cut = bestFirstOfTwoCuts(part.piece);
      part.looked_ahead = true;
    }
  }

  std::optional<ClosedMesh> solid_;
  double least_gain_;
  std::vector<CutPiece> pieces_;
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
