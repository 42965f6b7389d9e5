// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/rounded_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "geometry/directed_edges.h"

namespace fcl_prob::detail {
namespace {

using Vector = Eigen::Vector3d;

/// Normals that are less apart turn by less than rounding off a chord.
constexpr long double kShortTurn = 1e-8L;

/// Slopes and heights of unit arcs that rounding tells nothing of.
constexpr long double kLevelSlope = 1e-14L;

/// Arcs are no longer than this.
constexpr double kLongestArc = 1.6;

/// Where the boundary of a section passes from one cell to another.
struct SectionCrossing {
  bool enters;
  LongVector3 point, normal;
  long double angle;  ///< in the cell
};

/// The normals across an edge, from `first` to `last`: about the edge, from `from` to `to`,
/// anticlockwise.
struct EdgeWedge {
  int from, to;
  Vector first, last;
};

class SectionBuilder {
 public:
  SectionBuilder(const ConvexPolytope& core, const std::vector<Vector>& normals, double radius,
                 const SectionPlane& plane)
      : core_(core),
        normals_(normals),
        radius_(radius),
        plane_(plane),
        corners_(core.vertices.size()) {
    across_ = plane.normal.unitOrthogonal().normalized();
    aside_ = plane.normal.cross(across_);
    for (const Vector& v : core.vertices) {
      heights_.push_back(plane.normal.dot(v.cast<long double>() + plane.origin));
    }
  }

  std::optional<RoundedSection> build() {
    bool fits = core_.vertices.size() > 1;
    fits = fits && (core_.faces.empty() ? addSegment() : addFaces());
    for (std::size_t v = 0; fits && v < corners_.size(); ++v) fits = addCorner(v);
    if (!fits) return std::nullopt;
    if (section_.pieces.empty()) addWholeCircle();
    return std::move(section_);
  }

 private:
  LongVector3 at(int vertex) const {
    return core_.vertices[static_cast<std::size_t>(vertex)].cast<long double>();
  }

  /// Of a corner moved along a normal.
  long double height(int vertex, const Vector& normal) const {
    return heights_[static_cast<std::size_t>(vertex)] +
           radius_ * plane_.normal.dot(normal.cast<long double>());
  }
  bool isAbove(int vertex, const Vector& normal) const { return height(vertex, normal) >= 0.0L; }

  /// On an edge that is moved along a normal, the same for either direction.
  LongVector3 crossingOf(int from, int to, const Vector& normal) const {
    if (from > to) std::swap(from, to);
    const long double a = height(from, normal), b = height(to, normal);
    const long double share = std::clamp(a / (a - b), 0.0L, 1.0L);
    return at(from) + share * (at(to) - at(from)) + radius_ * normal.cast<long double>();
  }

  bool addFaces() {
    std::vector<DirectedEdge> sides;
    for (std::size_t f = 0; f < core_.faces.size(); ++f) {
      const auto& corners = core_.faces[f].vertices;
      if (!addFace(corners, normals_[f])) return false;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        sides.push_back({corners[k], corners[(k + 1) % corners.size()], static_cast<int>(f)});
      }
    }
    const EdgePairing pairing = pairEdges(std::move(sides));
    if (pairing.fault) return false;
    return std::all_of(pairing.matches.begin(), pairing.matches.end(),
                       [&](const EdgeMatch& match) { return addEdge(match); });
  }

  bool addFace(const std::vector<int>& corners, const Vector& normal) {
    std::vector<SectionCrossing> crossings;
    const LongVector3 along = normal.cast<long double>();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int from = corners[k], to = corners[(k + 1) % corners.size()];
      if (isAbove(from, normal) == isAbove(to, normal)) continue;
      crossings.push_back({isAbove(from, normal), crossingOf(from, to, normal), along, 0.0L});
    }
    if (crossings.empty()) return true;
    if (crossings.size() != 2) return false;
    const SectionCrossing &one = crossings[0], &other = crossings[1];
    addSegmentPiece(one.enters ? one.point : other.point, one.enters ? other.point : one.point);
    return true;
  }

  /// By way of a normal in between, so that no wedge turns by more than a right angle.
  bool addEdge(const EdgeMatch& match) {
    const int from = match.forward.from, to = match.forward.to;
    const Vector first = normals_[static_cast<std::size_t>(match.forward.polygon)],
                 last = normals_[static_cast<std::size_t>(match.backward.polygon)];
    const Vector along = core_.vertices[static_cast<std::size_t>(to)] -
                         core_.vertices[static_cast<std::size_t>(from)];
    const Vector middle =
        (along.cross(first).stableNormalized() + last.cross(along).stableNormalized())
            .stableNormalized();
    measure(middle, from);
    measure(middle, to);
    return addWedge({from, to, first, middle}) && addWedge({from, to, middle, last});
  }

  /// How far the core reaches beyond the plane through a corner.
  void measure(const Vector& normal, int corner) {
    const Vector& point = core_.vertices[static_cast<std::size_t>(corner)];
    for (const Vector& v : core_.vertices) {
      section_.defect = std::max(section_.defect, normal.dot(v - point));
    }
  }

  /// All around a segment.
  bool addSegment() {
    const Vector along = (core_.vertices[1] - core_.vertices[0]).stableNormalized();
    const Vector x = along.unitOrthogonal(), y = along.cross(x);
    const std::array<Vector, 4> around{x, y, Vector(-x), Vector(-y)};
    for (std::size_t k = 0; k < 4; ++k) {
      measure(around[k], 0);
      measure(around[k], 1);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      if (!addWedge({0, 1, around[k], around[(k + 1) % 4]})) return false;
    }
    return true;
  }

  bool addWedge(const EdgeWedge& wedge) {
    std::vector<SectionCrossing> crossings;
    const LongVector3 first = wedge.first.cast<long double>(),
                      last = wedge.last.cast<long double>();
    // Anticlockwise, seen from outside: up the arc at `from`, along, down the arc at `to`, back.
    addArcCrossings(wedge, wedge.from, true, crossings);
    if (isAbove(wedge.from, wedge.last) != isAbove(wedge.to, wedge.last)) {
      crossings.push_back({isAbove(wedge.from, wedge.last),
                           crossingOf(wedge.from, wedge.to, wedge.last), last,
                           turnOf(first, last)});
    }
    addArcCrossings(wedge, wedge.to, false, crossings);
    if (isAbove(wedge.from, wedge.first) != isAbove(wedge.to, wedge.first)) {
      crossings.push_back({isAbove(wedge.to, wedge.first),
                           crossingOf(wedge.from, wedge.to, wedge.first), first, 0.0L});
    }
    if (crossings.empty()) return true;
    std::sort(crossings.begin(), crossings.end(),
              [](const SectionCrossing& x, const SectionCrossing& y) { return x.angle < y.angle; });
    std::vector<SectionCrossing> entries, exits;
    for (const SectionCrossing& crossing : crossings) {
      (crossing.enters ? entries : exits).push_back(crossing);
    }
    if (entries.size() != exits.size()) return false;
    for (std::size_t k = 0; k < entries.size(); ++k) addOfCylinder(wedge, entries[k], exits[k]);
    return true;
  }

  static long double turnOf(const LongVector3& first, const LongVector3& last) {
    return std::atan2(first.cross(last).norm(), first.dot(last));
  }

  /// Where a corner moved along the arc of normals crosses the plane: the height is that of the
  /// corner and radius (a cos θ + b sin θ).
  void addArcCrossings(const EdgeWedge& wedge, int corner, bool upwards,
                       std::vector<SectionCrossing>& crossings) {
    const LongVector3 first = wedge.first.cast<long double>(),
                      last = wedge.last.cast<long double>();
    const LongVector3 aside = (last - first * first.dot(last) / first.squaredNorm()).normalized();
    const long double a = plane_.normal.dot(first), b = plane_.normal.dot(aside);
    const bool above = isAbove(corner, wedge.first), ends_above = isAbove(corner, wedge.last);
    const long double level = -heights_[static_cast<std::size_t>(corner)] / radius_;
    const long double side = above ? -1.0L : 1.0L;
    const bool turns_back = mayTurnBack(first, last, side * a, side * b, side * level);
    if (above == ends_above && !turns_back) return;
    const long double turn = turnOf(first, last);
    const long double most = std::hypot(a, b), top = std::atan2(b, a);
    std::vector<long double> angles;
    const auto within = [&](long double angle) { return angle > 0.0L && angle < turn; };
    const long double away = std::acos(std::clamp(level / most, -1.0L, 1.0L));
    if (above != ends_above) {
      angles.push_back(nearestWithin(turn, {top - away, top + away}));
    } else if (!above && within(top) && level < most) {
      angles = {std::max(top - away, 0.0L), std::min(top + away, turn)};
    } else if (above) {
      const long double bottom = top > 0.0L ? top - M_PIl : top + M_PIl;
      const long double off = std::acos(std::clamp(-level / most, -1.0L, 1.0L));
      if (within(bottom) && level > -most) {
        angles = {std::max(bottom - off, 0.0L), std::min(bottom + off, turn)};
      }
    }
    bool is_above = above;
    for (const long double angle : angles) {
      const LongVector3 normal = std::cos(angle) * first + std::sin(angle) * aside;
      const bool enters = is_above == upwards;
      const LongVector3 point = at(corner) + radius_ * normal;
      crossings.push_back({enters, point, normal, angle});
      corners_[static_cast<std::size_t>(corner)].push_back({!enters, point, normal, 0.0L});
      is_above = !is_above;
    }
  }

  /// Whether a cos θ + b sin θ may be largest between two normals, and above a level there: most
  /// arcs are known by that not to cross the plane.
  static bool mayTurnBack(const LongVector3& first, const LongVector3& last, long double a,
                          long double b, long double level) {
    const long double slope_at_last = b * first.dot(last) - a * first.cross(last).norm();
    return b > -kLevelSlope && slope_at_last < kLevelSlope &&
           level < std::abs(a) + std::abs(b) + kLevelSlope;
  }

  /// Of two angles, up to whole turns, that which is nearest to what is within.
  static long double nearestWithin(long double turn, const std::array<long double, 2>& angles) {
    long double best = 0.0L, least = 1e9L;
    for (long double angle : angles) {
      angle -= 2.0L * M_PIl * std::round((angle - 0.5L * turn) / (2.0L * M_PIl));
      const long double inside = std::clamp(angle, 0.0L, turn);
      if (std::abs(angle - inside) < least) {
        least = std::abs(angle - inside);
        best = inside;
      }
    }
    return best;
  }

  /// Of a cylinder around the edge, seen along it on the plane.
  void addOfCylinder(const EdgeWedge& wedge, const SectionCrossing& from,
                     const SectionCrossing& to) {
    const LongVector3 along = at(wedge.to) - at(wedge.from);
    const long double rise = plane_.normal.dot(along);
    const bool is_short = (from.normal - to.normal).norm() < kShortTurn;
    if (is_short || rise == 0.0L) {
      section_.defect = std::max(
          section_.defect, static_cast<double>(radius_ * (from.normal - to.normal).squaredNorm()));
      addSegmentPiece(from.point, to.point);
      return;
    }
    const long double height = heights_[static_cast<std::size_t>(wedge.from)];
    SectionPiece piece;
    piece.is_arc = true;
    piece.from = from.point;
    piece.to = to.point;
    piece.centre = at(wedge.from) - height / rise * along;
    piece.image = radius_ * (LongMatrix3::Identity() - along * plane_.normal.transpose() / rise);
    piece.first = from.normal;
    piece.last = to.normal;
    section_.pieces.push_back(piece);
  }

  void addSegmentPiece(const LongVector3& from, const LongVector3& to) {
    SectionPiece piece;
    piece.from = from;
    piece.to = to;
    section_.pieces.push_back(piece);
  }

  /// Of a sphere around a corner: from where the boundary enters its cell, anticlockwise.
  bool addCorner(std::size_t corner) {
    auto& crossings = corners_[corner];
    for (SectionCrossing& crossing : crossings) {
      crossing.angle = std::atan2(crossing.normal.dot(aside_), crossing.normal.dot(across_));
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const SectionCrossing& x, const SectionCrossing& y) { return x.angle < y.angle; });
    for (std::size_t k = 0; k < crossings.size(); ++k) {
      const SectionCrossing &from = crossings[k], &to = crossings[(k + 1) % crossings.size()];
      if (from.enters == to.enters) return false;
      if (!from.enters) continue;
      long double turn = to.angle - from.angle;
      if (k + 1 == crossings.size()) turn += 2.0L * M_PIl;
      addCircle(corner, from.angle, turn, from.point, to.point);
    }
    return true;
  }

  LongVector3 direction(long double angle) const {
    return std::cos(angle) * across_ + std::sin(angle) * aside_;
  }

  void addCircle(std::size_t corner, long double from, long double turn, const LongVector3& first,
                 const LongVector3& last) {
    const long double height = heights_[corner];
    const long double radius = circleRadius(corner);
    const LongVector3 centre = core_.vertices[corner].cast<long double>() - height * plane_.normal;
    const int count = std::max(1, static_cast<int>(std::ceil(turn / kLongestArc)));
    for (int k = 0; k < count; ++k) {
      SectionPiece piece;
      piece.is_arc = true;
      piece.first = direction(from + turn * k / count);
      piece.last = direction(from + turn * (k + 1) / count);
      piece.centre = centre;
      piece.image = radius * LongMatrix3::Identity();
      piece.from = k == 0 ? first : LongVector3(centre + radius * piece.first);
      piece.to = k + 1 == count ? last : LongVector3(centre + radius * piece.last);
      section_.pieces.push_back(piece);
    }
  }

  /// Where no border is crossed the section is nothing or a whole circle around a corner: that
  /// which the others reach the least beyond.
  void addWholeCircle() {
    const auto [lowest, highest] = std::minmax_element(heights_.begin(), heights_.end());
    if (*lowest > radius_ || *highest < -radius_) return;
    std::size_t best = 0;
    long double least = kInfinity;
    for (std::size_t v = 0; v < corners_.size(); ++v) {
      const long double beyond = reachBeyond(v);
      if (!(beyond < least)) continue;
      least = beyond;
      best = v;
    }
    section_.defect = std::max(section_.defect, static_cast<double>(std::max(least, 0.0L)));
    addCircle(best, 0.0L, 2.0L * M_PIl, startOf(best), startOf(best));
  }

  long double circleRadius(std::size_t corner) const {
    const long double height = heights_[corner];
    return std::sqrt(std::max(0.0L, (radius_ - height) * (radius_ + height)));
  }

  LongVector3 startOf(std::size_t corner) const {
    return core_.vertices[corner].cast<long double>() - heights_[corner] * plane_.normal +
           circleRadius(corner) * direction(0.0L);
  }

  /// How far the core reaches beyond the plane through a corner, seen along a point of its circle.
  long double reachBeyond(std::size_t corner) const {
    if (!(std::abs(heights_[corner]) <= radius_)) return kInfinity;
    const LongVector3 point = core_.vertices[corner].cast<long double>();
    const LongVector3 normal = (startOf(corner) - point) / radius_;
    long double most = 0.0L;
    for (const Vector& other : core_.vertices) {
      most = std::max(most, normal.dot(other.cast<long double>() - point));
    }
    return most;
  }

  const ConvexPolytope& core_;
  const std::vector<Vector>& normals_;
  long double radius_;
  const SectionPlane& plane_;
  LongVector3 across_, aside_;                         ///< in the plane
  std::vector<long double> heights_;                   ///< of corners above the plane
  std::vector<std::vector<SectionCrossing>> corners_;  ///< of their cells' borders
  RoundedSection section_;
};

}  // namespace

std::optional<RoundedSection> roundedSection(const ConvexPolytope& core,
                                             const std::vector<Vector>& normals, double radius,
                                             const SectionPlane& plane) {
  return SectionBuilder(core, normals, radius, plane).build();
}

}  // namespace fcl_prob::detail
