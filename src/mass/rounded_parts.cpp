// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/rounded_parts.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "geometry/directed_edges.h"

namespace fcl_prob::detail {
namespace {

using Vector = Eigen::Vector3d;

/// A wedge or a sector does not reach over more than about 106 degrees: this is the cosine.
constexpr double kWidestArc = -0.28;
constexpr double kWidestFan = -0.05;

/// How often a normal between others is moved, which decides about whether it is of use only.
constexpr int kNormalSteps = 40;

/// Cosine between some direction and each of a sector's corners, at least: its inverse is how much
/// more than the corners' a defect can be in between. There is one of 0.38 where corners are no
/// farther apart than kWidestArc and kWidestFan allow.
constexpr double kNarrowestMiddle = 1.0 / 3.0;

/// The same of sectors that few points integrate; others are divided.
constexpr double kNarrowSector = 0.8;

/// Parallelograms are told from other faces by what rounding leaves of four corners.
constexpr double kFourRoundings = 8.0 * kEpsilon;

/// More than this of the core's size is no rounding: another normal may be better.
constexpr double kGoodDefect = 64.0 * kEpsilon;

/// Of a face's longest edge squared: with less area its own normal is no more than rounding.
constexpr double kLeastArea = 1e-9;

/// Of the core's size: what the normal of a neighbour may be wrong by for a face that has none.
constexpr double kMostBorrowed = 1e-8;

/// By how much the solid angles of all sectors may differ from a whole sphere, as a share of it.
constexpr double kLeastTurn = 0.1;

/// From n₁ to n₂ across an edge; n₁ is that of the face that walks it from `from` to `to`.
struct NormalArc {
  int from, to;
  Vector first, second;
};

/// Signed, of the triangle between three unit vectors (Van Oosterom and Strackee 1983).
double solidAngle(const Vector& a, const Vector& b, const Vector& c) {
  return 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

double leastCosine(const Vector& middle, const std::array<Vector, 3>& corners) {
  const Vector unit = middle.normalized();
  return std::min({unit.dot(corners[0]), unit.dot(corners[1]), unit.dot(corners[2])});
}

/// Of the least cap around three unit vectors, which the longest side or all three span.
double capCosine(const std::array<Vector, 3>& corners) {
  const auto& [n0, n1, n2] = corners;
  const Vector across = (n1 - n0).cross(n2 - n0);
  double widest = leastCosine(across.dot(n0) < 0.0 ? Vector(-across) : across, corners);
  for (const Vector& side : {Vector(n0 + n1), Vector(n1 + n2), Vector(n2 + n0)}) {
    widest = std::max(widest, leastCosine(side, corners));
  }
  return widest;
}

double worstOf(const Vector& vector, const std::vector<Vector>& normals) {
  double worst = kInfinity;
  for (const Vector& normal : normals) worst = std::min(worst, vector.dot(normal));
  return worst;
}

/// A normal between others, which are hardly more than a right angle from it: on the way from their
/// mean to the point of their hull that is nearest to the origin (Gilbert 1966). A sum of normals
/// wherever it ends.
Vector normalBetween(const std::vector<Vector>& normals) {
  Vector sum = Vector::Zero();
  for (const Vector& normal : normals) sum += normal / static_cast<double>(normals.size());
  for (int step = 0; step < kNormalSteps; ++step) {
    const Vector& next = *std::min_element(
        normals.begin(), normals.end(),
        [&](const Vector& x, const Vector& y) { return sum.dot(x) < sum.dot(y); });
    if (sum.dot(next) >= 0.5 * kWidestFan * sum.norm()) break;
    const Vector way = next - sum;
    sum -= sum.dot(way) / way.squaredNorm() * way;
  }
  return sum;
}

class RoundedPartsBuilder {
 public:
  RoundedPartsBuilder(const ConvexPolytope& core, const LongVector3& origin,
                      const LongMatrix3& whitening)
      : core_(core),
        origin_(origin),
        whitening_(whitening),
        stretch_(static_cast<double>(whitening.norm()) * (1.0 + kEpsilon)),
        volume_(static_cast<double>(std::abs(whitening.determinant()))) {
    for (const Vector& v : core.vertices) size_ = std::max(size_, (v - core.vertices[0]).norm());
  }

  std::optional<RoundedParts> build() {
    const std::size_t count = core_.vertices.size();
    if (count == 1) {
      addPoint();
    } else if (core_.faces.empty()) {
      if (count != 2) return std::nullopt;
      addSegment();
    } else {
      if (!findArcs()) return std::nullopt;
      for (std::size_t f = 0; f < core_.faces.size(); ++f) {
        // The two sides of a polygon must not leave a gap between them.
        if (f == 1 && core_.faces.size() == 2)
          addOtherSide();
        else
          addFace(f);
      }
      for (const NormalArc& arc : arcs_) addWedge(arc);
      if (!addCorners()) return std::nullopt;
    }
    parts_.defect = worst_ / kNarrowestMiddle + 3.0 * kFourRoundings * size_;
    parts_.stretch = stretch_;
    if (!std::isfinite(parts_.defect) || !is_fit_ || !windsOnce()) return std::nullopt;
    return std::move(parts_);
  }

 private:
  /// The normals of the outer surface go around the sphere once.
  bool windsOnce() const {
    constexpr double kSphere = 4.0 * M_PI;
    return std::abs(turned_ / kSphere - 1.0) <= kLeastTurn;
  }

  const Vector& at(int vertex) const { return core_.vertices[static_cast<std::size_t>(vertex)]; }

  /// How far the core reaches beyond the plane through a point.
  double defectOf(const Vector& normal, const Vector& point) const {
    double most = 0.0;
    for (const Vector& v : core_.vertices) most = std::max(most, normal.dot(v - point));
    return most;
  }
  double defectOf(const Vector& normal, const ConvexPolytope::Face& face) const {
    double lowest = 0.0;
    const Vector& origin = at(face.vertices[0]);
    for (const int corner : face.vertices) {
      lowest = std::min(lowest, normal.dot(at(corner) - origin));
    }
    return defectOf(normal, origin) - lowest;
  }

  void addPoint() {
    for (int signs = 0; signs < 8; ++signs) {
      std::array<Vector, 3> n;
      for (int k = 0; k < 3; ++k) {
        n[static_cast<std::size_t>(k)] = ((signs >> k) & 1 ? 1.0 : -1.0) * Vector::Unit(k);
      }
      const bool even = n[0].cross(n[1]).dot(n[2]) > 0.0;
      addSector(0, n[0], even ? n[1] : n[2], even ? n[2] : n[1]);
    }
  }

  void addSegment() {
    const Vector along = (at(1) - at(0)).stableNormalized();
    const Vector u = along.unitOrthogonal(), v = along.cross(u);
    const std::array<Vector, 4> around{u, v, Vector(-u), Vector(-v)};
    for (const Vector& n : around) {
      worst_ = std::max(worst_, std::abs(n.dot(at(1) - at(0))));
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector &first = around[k], &second = around[(k + 1) % 4];
      addWedge({0, 1, first, second});
      addSector(1, along, first, second);
      addSector(0, -along, second, first);
    }
  }

  /// Normals of the faces, where theirs are rounding those of neighbours, and the arcs between
  /// them.
  bool findArcs() {
    std::vector<DirectedEdge> walked;
    for (std::size_t f = 0; f < core_.faces.size(); ++f) {
      const std::vector<int>& corners = core_.faces[f].vertices;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        walked.push_back({corners[k], corners[(k + 1) % corners.size()], static_cast<int>(f)});
      }
    }
    const EdgePairing pairing = pairEdges(std::move(walked));
    if (pairing.fault) return false;
    if (!findNormals(pairing.matches)) return false;
    for (const EdgeMatch& match : pairing.matches) {
      const auto left = static_cast<std::size_t>(match.forward.polygon);
      const auto right = static_cast<std::size_t>(match.backward.polygon);
      addArc({match.forward.from, match.forward.to, parts_.normals[left], parts_.normals[right]});
    }
    return true;
  }

  bool hasNormal(const ConvexPolytope::Face& face) const {
    const Vector& origin = at(face.vertices[0]);
    Vector twice = Vector::Zero();
    double longest = 0.0;
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const Vector& from = at(face.vertices[k]);
      const Vector& to = at(face.vertices[(k + 1) % face.vertices.size()]);
      twice += (from - origin).cross(to - origin);
      longest = std::max(longest, (to - from).squaredNorm());
    }
    return twice.norm() > 2.0 * kLeastArea * longest;
  }

  /// False if a face that has none is nowhere next to one that has.
  bool findNormals(const std::vector<EdgeMatch>& matches) {
    std::vector<double> defects;
    std::vector<bool> known;
    for (const ConvexPolytope::Face& face : core_.faces) {
      parts_.normals.push_back(face.normal);
      defects.push_back(defectOf(face.normal, face));
      known.push_back(hasNormal(face));
    }
    const auto improve = [&](int face, int neighbour) {
      const auto f = static_cast<std::size_t>(face), g = static_cast<std::size_t>(neighbour);
      if (!known[g] || (known[f] && defects[f] <= kGoodDefect * size_)) return;
      const double other = defectOf(parts_.normals[g], core_.faces[f]);
      if (known[f] ? !(other < defects[f]) : other > kMostBorrowed * size_) return;
      defects[f] = other;
      parts_.normals[f] = parts_.normals[g];
      known[f] = true;
    };
    for (const EdgeMatch& match : matches) {
      improve(match.forward.polygon, match.backward.polygon);
      improve(match.backward.polygon, match.forward.polygon);
    }
    for (const double defect : defects) worst_ = std::max(worst_, defect);
    return std::all_of(known.begin(), known.end(), [](bool is_known) { return is_known; });
  }

  void addArc(const NormalArc& arc) {
    if (arc.first.dot(arc.second) >= kWidestArc) {
      arcs_.push_back(arc);
      return;
    }
    const Vector along = at(arc.to) - at(arc.from);
    const Vector middle =
        (along.cross(arc.first).stableNormalized() + arc.second.cross(along).stableNormalized())
            .stableNormalized();
    worst_ = std::max({worst_, defectOf(middle, at(arc.from)), defectOf(middle, at(arc.to))});
    is_fit_ =
        is_fit_ && middle.dot(arc.first) >= kWidestArc && middle.dot(arc.second) >= kWidestArc;
    arcs_.push_back({arc.from, arc.to, arc.first, middle});
    arcs_.push_back({arc.from, arc.to, middle, arc.second});
  }

  void addFace(std::size_t f) {
    const std::vector<int>& corners = core_.faces[f].vertices;
    const Vector& v = at(corners[0]);
    const auto edge = [&](std::size_t k) -> Vector { return at(corners[k]) - v; };
    if (corners.size() == 4 &&
        (edge(1) - edge(2) + edge(3)).cwiseAbs().maxCoeff() <= kFourRoundings * size_) {
      addPrism(f, edge(1), edge(3), false);
      return;
    }
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      addPrism(f, edge(k), at(corners[k + 1]) - at(corners[k]), true);
    }
  }

  Vector image(const Vector& vector) const { return whitened(whitening_, vector); }

  void setMap(SolidPart& part, int vertex, double determinant, double error) {
    part.corner = whitened(whitening_, at(vertex), origin_);
    part.factor = volume_ * determinant;
    part.factor_error = volume_ * (error + 16.0 * kEpsilon * std::abs(determinant));
  }

  void addPrism(std::size_t f, const Vector& first, const Vector& second, bool triangle) {
    Prism part;
    setMap(part, core_.faces[f].vertices[0], first.cross(second).dot(parts_.normals[f]),
           8.0 * kEpsilon * first.norm() * second.norm());
    part.first = image(first);
    part.second = image(second);
    part.along = image(parts_.normals[f]);
    part.triangle = triangle;
    part.position_error =
        8.0 * kEpsilon * (part.corner.norm() + part.first.norm() + part.second.norm());
    parts_.parts.emplace_back(part);
  }

  void addOtherSide() {
    const std::size_t count = parts_.parts.size();
    const Vector along = image(parts_.normals[1]);
    for (std::size_t k = 0; k < count; ++k) {
      Prism part = std::get<Prism>(parts_.parts[k]);
      part.factor *= -parts_.normals[0].dot(parts_.normals[1]);
      part.along = along;
      parts_.parts.emplace_back(part);
    }
  }

  void addWedge(const NormalArc& arc) {
    const Vector step = arc.second - arc.first;
    const double chord = step.norm();
    if (!(chord > 0.0)) return;
    const Vector& p = arc.first;
    // For close normals the difference is exact.
    const Vector q = (step - p * p.dot(step)).normalized();
    const Vector edge = at(arc.to) - at(arc.from);
    Wedge part;
    setMap(part, arc.from, edge.dot(p.cross(q)), edge.norm() * kEpsilon * (16.0 + 8.0 / chord));
    part.edge = image(edge);
    part.p = image(p);
    part.q = image(q);
    part.angle = chord < 1.0 ? 2.0 * std::asin(0.5 * chord)
                             : std::atan2(q.dot(arc.second), p.dot(arc.second));
    part.position_error = 8.0 * kEpsilon * (part.corner.norm() + part.edge.norm());
    parts_.parts.emplace_back(part);
  }

  /// At every corner a fan of sectors over its arcs, from one of its normals or from their middle.
  bool addCorners() {
    std::vector<std::vector<const NormalArc*>> around(core_.vertices.size());
    for (const NormalArc& arc : arcs_) {
      around[static_cast<std::size_t>(arc.from)].push_back(&arc);
      around[static_cast<std::size_t>(arc.to)].push_back(&arc);
    }
    for (std::size_t v = 0; v < around.size(); ++v) {
      const int vertex = static_cast<int>(v);
      if (around[v].empty()) continue;
      const std::optional<Vector> apex = apexOf(vertex, around[v]);
      if (!apex) return false;
      for (const NormalArc* arc : around[v]) {
        if (arc->to == vertex) addSector(vertex, *apex, arc->first, arc->second);
        if (arc->from == vertex) addSector(vertex, *apex, arc->second, arc->first);
      }
    }
    return true;
  }

  std::optional<Vector> apexOf(int vertex, const std::vector<const NormalArc*>& around) {
    std::vector<Vector> normals;
    for (const NormalArc* arc : around) {
      normals.push_back(arc->first);
      normals.push_back(arc->second);
    }
    const auto& best =
        *std::max_element(normals.begin(), normals.end(), [&](const Vector& x, const Vector& y) {
          return worstOf(x, normals) < worstOf(y, normals);
        });
    if (worstOf(best, normals) >= kWidestFan) return best;
    const Vector between = normalBetween(normals);
    if (!(between.norm() > 0.0)) return std::nullopt;
    const Vector middle = between.normalized();
    worst_ = std::max(worst_, defectOf(middle, at(vertex)));
    return middle;
  }

  void addSector(int vertex, const Vector& n0, const Vector& n1, const Vector& n2) {
    if (n0 == n1 || n1 == n2 || n2 == n0) return;
    const std::array<Vector, 3> corners{n0, n1, n2};
    const double cosine = leastCosine(n0 + n1 + n2, corners);
    is_fit_ = is_fit_ && (cosine >= kNarrowestMiddle || capCosine(corners) >= kNarrowestMiddle);
    if (cosine < kNarrowSector && is_fit_) {
      const Vector m01 = (n0 + n1).normalized(), m12 = (n1 + n2).normalized(),
                   m20 = (n2 + n0).normalized();
      addSector(vertex, n0, m01, m20);
      addSector(vertex, n1, m12, m01);
      addSector(vertex, n2, m20, m12);
      addSector(vertex, m01, m12, m20);
      return;
    }
    turned_ += solidAngle(n0, n1, n2);
    Sector part;
    part.normals = {n0, n1 - n0, n2 - n1};
    const Vector to_second = n2 - n0;
    setMap(part, vertex, n0.dot(part.normals[1].cross(to_second)),
           8.0 * kEpsilon * part.normals[1].norm() * to_second.norm());
    for (std::size_t k = 0; k < 3; ++k) part.whitened[k] = image(part.normals[k]);
    part.stretch = stretch_;
    part.position_error = 8.0 * kEpsilon * part.corner.norm();
    parts_.parts.emplace_back(part);
  }

  const ConvexPolytope& core_;
  const LongVector3& origin_;
  const LongMatrix3& whitening_;
  double stretch_, volume_, size_ = 0.0;
  std::vector<NormalArc> arcs_;
  double worst_ = 0.0;
  double turned_ = 0.0;  // solid angle of all sectors
  bool is_fit_ = true;
  RoundedParts parts_;
};

}  // namespace

void RoundedParts::setRadius(double radius) {
  for (AnyPart& any : parts) {
    std::visit(
        [&](SolidPart& part) {
          // The error of before was for another radius.
          part.position_error += 8.0 * kEpsilon * stretch * (radius - part.radius);
          part.radius = radius;
        },
        any);
  }
}

std::optional<RoundedParts> roundedParts(const ConvexPolytope& core, const LongVector3& origin,
                                         const LongMatrix3& whitening) {
  return RoundedPartsBuilder(core, origin, whitening).build();
}

}  // namespace fcl_prob::detail
