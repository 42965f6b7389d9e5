// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/solid_mass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/constants.h"
#include "mass/polytope_clip.h"
#include "mass/tetrahedron_mass.h"

namespace fcl_prob::detail {
namespace {

using Eigen::Vector3d;

// Bounds of a piece's cubature and of what is left out, relative to the mass; or to the width that
// is enough.
constexpr double kPieceTolerance = 1e-15;
constexpr double kPieceShareOfEnough = 1e-3;
constexpr double kNegligible = 1e-17;
constexpr double kNegligibleShareOfEnough = 1e-5;

// How far a cut may move a vertex, in units of the size of the body: no plane is farther from the
// anchor.
constexpr double kCutRounding = 2 * kClipTolerance + 2 * kEpsilon;

// Part of the body, its vertices relative to the anchor.
struct Piece {
  ConvexPolytope body;
  std::vector<Tetrahedron> tetrahedra;
  double volume = 0.0;
  double volume_error = 0.0;
  double density_upper = 0.0;
  double density_lower = 0.0;

  Piece(const Vector3d& anchor, ConvexPolytope polytope) : body(std::move(polytope)) {
    for (const ConvexPolytope::Face& face : body.faces) addFan(anchor, face.vertices);
    density_lower = std::numeric_limits<double>::infinity();
    for (const Tetrahedron& t : tetrahedra) {
      volume += t.volume;
      volume_error += t.volume_error;
      density_upper = std::max(density_upper, t.densityUpper());
      density_lower = std::min(density_lower, t.densityLower());
    }
  }

  // Bound on its mass.
  double most() const { return (volume + volume_error) * density_upper; }

  void addFan(const Vector3d& anchor, const std::vector<int>& loop) {
    if (std::find(loop.begin(), loop.end(), 0) != loop.end()) return;
    const auto at = [&](std::size_t k) { return body.vertices[static_cast<std::size_t>(loop[k])]; };
    for (std::size_t k = 2; k < loop.size(); ++k) {
      tetrahedra.emplace_back(anchor,
                              std::array<Vector3d, 4>{body.vertices[0], at(0), at(k - 1), at(k)});
    }
  }
};

// The plane across the direction in which the density is hardest to follow.
HalfSpace middlePlane(const Vector3d& anchor, const ConvexPolytope& body) {
  const Vector3d& apex = body.vertices[0];
  Vector3d hardest = Vector3d::UnitX();
  double most = 0;
  for (const Vector3d& vertex : body.vertices) {
    const Vector3d step = vertex - apex;
    const double slope =
        std::max(std::abs((anchor + apex).dot(step)), std::abs((anchor + vertex).dot(step)));
    const double difficulty = slope + step.squaredNorm();
    if (difficulty > most) {
      most = difficulty;
      hardest = step;
    }
  }
  const Vector3d normal = hardest.stableNormalized();
  return {normal, normal.dot(apex + 0.5 * hardest)};
}

class SolidIntegral {
 public:
  SolidIntegral(const Vector3d& anchor, const ConvexPolytope& body, double lower_bound,
                const MassEffort& effort)
      : anchor_(anchor),
        piece_tolerance_(std::max(kPieceTolerance, kPieceShareOfEnough * effort.enough)),
        negligible_(std::max(kNegligible, kNegligibleShareOfEnough * effort.enough)),
        interruption_(effort.interruption) {
    for (const Vector3d& vertex : body.vertices) size_ = std::max(size_, vertex.norm());
    open_.emplace_back(anchor_, body);
    known_ = std::max(lower_bound, open_.back().volume * open_.back().density_lower);
  }

  std::optional<SolidMass> integrate(int max_pieces) {
    int pieces = 0;
    while (!open_.empty()) {
      if (++pieces > max_pieces || interrupted_) return std::nullopt;
      const Piece piece = takeHeaviest();
      const double most = piece.most();
      if (most <= negligible_ * known_) {
        sum_.error += most;
      } else if (!integratePiece(piece)) {
        cut(piece);
      }
    }
    if (interrupted_) return std::nullopt;
    sum_.error += pieces * kEpsilon * sum_.value;
    return SolidMass{sum_, pieces > 1 ? kCutRounding * size_ : 0.0};
  }

 private:
  // First, so that it is soon known what the rest is to be measured by.
  Piece takeHeaviest() {
    const auto heaviest =
        std::max_element(open_.begin(), open_.end(),
                         [](const Piece& p, const Piece& q) { return p.most() < q.most(); });
    std::swap(*heaviest, open_.back());
    Piece piece = std::move(open_.back());
    open_.pop_back();
    return piece;
  }

  bool mustStop() {
    interrupted_ = interrupted_ || isDue(interruption_);
    return interrupted_;
  }

  // False if the piece has to be cut first.
  bool integratePiece(const Piece& piece) {
    std::vector<CubaturePlan> plans;
    for (const Tetrahedron& t : piece.tetrahedra) {
      if (mustStop()) return true;
      const double share = t.volume / piece.volume;
      const double least = piece.volume * piece.density_lower;
      const double tolerance = piece_tolerance_ * std::max(share * least, 1e-2 * known_);
      plans.push_back(planCubature(t, tolerance));
      if (plans.back().points == 0) return false;
    }
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (mustStop()) return true;
      const MassWithError mass = tetrahedronMass(piece.tetrahedra[k], plans[k]);
      sum_.value += mass.value;
      sum_.error += mass.error;
    }
    known_ = std::max(known_, sum_.value - sum_.error);
    return true;
  }

  void cut(const Piece& piece) {
    const HalfSpace plane = middlePlane(anchor_, piece.body);
    double extent = 0;
    for (const Vector3d& v : piece.body.vertices) {
      extent = std::max(extent, std::abs(plane.normal.dot(v) - plane.offset));
    }
    // Later cuts of one half move the common face by rounding; its area is at most 3 volume /
    // extent.
    sum_.error += kCutRounding * size_ * 3 * piece.volume / extent * piece.density_upper;
    open_.emplace_back(anchor_, clipped(piece.body, plane));
    open_.emplace_back(anchor_, clipped(piece.body, {-plane.normal, -plane.offset}));
  }

  Vector3d anchor_;
  std::vector<Piece> open_;
  MassWithError sum_;
  double known_ = 0.0;
  double size_ = 0.0;
  double piece_tolerance_;
  double negligible_;
  const Interruption& interruption_;
  bool interrupted_ = false;
};

}  // namespace

std::optional<SolidMass> solidMass(const ConvexPolytope& polytope, double lower_bound,
                                   int max_pieces, const MassEffort& effort) {
  const Vector3d anchor = polytope.vertices.front();
  ConvexPolytope body = polytope;
  for (Vector3d& vertex : body.vertices) vertex -= anchor;
  return SolidIntegral(anchor, body, lower_bound, effort).integrate(max_pieces);
}

}  // namespace fcl_prob::detail
