// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/polytope_section.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "bounds/section.h"
#include "fcl_prob/normal_mass.h"
#include "mass/long_whitening.h"
#include "mass/polygon_mass.h"
#include "mass/polytope_effort.h"
#include "mass/world_pair.h"

namespace fcl_prob::detail {
namespace {

using LongVector2 = Eigen::Matrix<long double, 2, 1>;

/// Of points on edges and of cuts, in kLongEpsilon, next to the farthest corner of the body.
constexpr long double kCutRounding = 8.0L * kLongEpsilon;

/// A turn is to the left if its cross product is more than this of its terms.
constexpr long double kTurnMargin = 16.0L * kLongEpsilon;

/// How far a body has to reach through the plane on both sides, next to what heights are rounded
/// by.
constexpr long double kLeastHeight = 1e3L;

/// In deviations: beyond this nothing is as much as the smallest double, and layers are no wider.
constexpr long double kWidestSection = 45.0L;
constexpr double kMostLayer = 1.0;

/// Of an end in deviations, rounded to a double.
constexpr double kEndOfLine = 2.0 * kEpsilon;

/// Smaller ones are integrated as solids.
constexpr long double kSmallSection = 0.3L;

/// Where an edge of the body, in the direction `edge`, passes through the plane.
struct PlaneCut {
  LongVector2 point;
  LongVector3 edge;
};

bool turnsSurelyLeft(const LongVector2& centre, const LongVector2& p, const LongVector2& q) {
  const LongVector2 u = p - centre, v = q - centre;
  const long double first = u.x() * v.y(), second = u.y() * v.x();
  return first - second > kTurnMargin * (std::abs(first) + std::abs(second));
}

/// Appends a chain of the hull but for its last point (Andrew 1979).
template <class Iterator>
void appendCuts(Iterator begin, Iterator end, std::vector<PlaneCut>& hull) {
  const std::size_t start = hull.size();
  for (Iterator it = begin; it != end; ++it) {
    while (hull.size() >= start + 2 &&
           !turnsSurelyLeft(hull[hull.size() - 2].point, hull.back().point, it->point)) {
      hull.pop_back();
    }
    hull.push_back(*it);
  }
  hull.pop_back();
}

std::vector<PlaneCut> hullOfCuts(std::vector<PlaneCut> cuts) {
  std::sort(cuts.begin(), cuts.end(), [](const PlaneCut& p, const PlaneCut& q) {
    return p.point.x() < q.point.x() || (p.point.x() == q.point.x() && p.point.y() < q.point.y());
  });
  std::vector<PlaneCut> hull;
  if (cuts.size() < 3) return hull;
  appendCuts(cuts.begin(), cuts.end(), hull);
  appendCuts(cuts.rbegin(), cuts.rend(), hull);
  return hull;
}

/// Whether a closed polygon goes once around a point, all turns to the left as seen from there.
bool goesOnceAbout(const std::vector<PlaneCut>& hull, const LongVector2& centre) {
  int rounds = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const LongVector2 &p = hull[k].point, &q = hull[(k + 1) % hull.size()].point;
    if (!turnsSurelyLeft(centre, p, q)) return false;
    if (p.y() < centre.y() && q.y() >= centre.y()) ++rounds;
  }
  return rounds == 1;
}

LongVector2 meanOf(const std::vector<LongVector2>& points) {
  LongVector2 sum = LongVector2::Zero();
  for (const LongVector2& p : points) sum += p / static_cast<long double>(points.size());
  return sum;
}

/// What is left of a polygon where sign x_axis <= kWidestSection.
std::vector<LongVector2> cutOff(const std::vector<LongVector2>& polygon, int axis,
                                long double sign) {
  std::vector<LongVector2> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const LongVector2 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const long double of_p = sign * p[axis] - kWidestSection,
                      of_q = sign * q[axis] - kWidestSection;
    if (of_p <= 0.0L) kept.push_back(p);
    if ((of_p <= 0.0L) != (of_q <= 0.0L)) kept.push_back(p + of_p / (of_p - of_q) * (q - p));
  }
  return kept;
}

class PolytopeSection {
 public:
  PolytopeSection(const PairFrame& frame, const WorldPair& pair,
                  const GaussianDisplacement& displacement) {
    // What does not move is in metres, and compared with none of the others.
    LongMatrix3 map = longInverseAxes(displacement);
    for (int k = 0; k < frame.rank; ++k) {
      map.row(k) /= static_cast<long double>(displacement.standardDeviations()[k]);
    }
    const LongVector3 stretch = map.rowwise().norm() * (1.0L + 4.0L * kLongEpsilon);
    rounding_ = 2.0L * pair.rounding * stretch;
    slack_ = pair.slack * stretch;
    for (const LongVector3& p : pair.of_b) body_.of_b.push_back(map * p);
    for (const LongVector3& p : pair.minus_a) body_.minus_a.push_back(map * p);
    body_.origin = map * pair.origin;
    map_ = map;
  }

  /// Whether the body is certainly on one side of the plane.
  bool misses() const {
    const long double margin = rounding_.z() + slack_.z();
    return body_.reach(LongVector3::UnitZ()) < -margin ||
           body_.reach(-LongVector3::UnitZ()) < -margin;
  }

  /// \param is_line  where the second coordinate is in metres, too
  Bounds mass(const SummedFaces& summed, const LongVector3& origin, bool is_line) {
    for (const LongVector3& corner : summed.corners) corners_.push_back(map_ * (corner + origin));
    if (corners_.size() < 3) return {0.0, 1.0};
    hull_ = hullOfCuts(cutEdges(summed.faces));
    if (hull_.size() < 3) return {0.0, 1.0};
    if (is_line) return lineMass();
    const std::vector<LongVector2> polygon = heavyPolygon();
    if (polygon.size() < 3) return {0.0, 1.0};
    std::vector<LongVector2> corners;
    for (const PlaneCut& cut : hull_) corners.push_back(cut.point);
    const LongVector2 beyond = lesserOf(layerBeyond(meanOf(polygon)), layerBeyond(meanOf(corners)));
    return massWithLayer(polygon, layerWithin().cwiseMax(beyond));
  }

 private:
  std::vector<PlaneCut> cutEdges(const FaceSet& faces) const {
    std::vector<PlaneCut> cuts;
    for (std::size_t f = 0; f < faces.faceCount(); ++f) {
      const int count = faces.cornerCount(f);
      for (int k = 0; k < count; ++k) {
        // Each is walked in both directions.
        const int from = faces.corner(f, k), to = faces.corner(f, (k + 1) % count);
        if (from < to) addCut(corner(from), corner(to), cuts);
      }
    }
    return cuts;
  }

  const LongVector3& corner(int k) const { return corners_[static_cast<std::size_t>(k)]; }

  static void addCut(const LongVector3& from, const LongVector3& to, std::vector<PlaneCut>& cuts) {
    if ((from.z() < 0.0L) == (to.z() < 0.0L)) return;
    const LongVector3 edge = to - from;
    const long double share = from.z() / (from.z() - to.z());
    cuts.push_back({(from + share * edge).head<2>(), edge});
  }

  /// How far the corners of the polygon may be from points of the section. They are from points of
  /// the body by what is rounded, at a height of no more than that, from where a corner on the
  /// other side of the plane is straight ahead.
  LongVector2 layerWithin() const {
    LongVector3 low = corners_.front(), high = low, farthest = LongVector3::Zero();
    for (const LongVector3& v : corners_) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
      farthest = farthest.cwiseMax(v.cwiseAbs());
    }
    const LongVector3 moved = rounding_ + kCutRounding * farthest;
    const long double height = std::min(high.z(), -low.z());
    if (!(height > kLeastHeight * moved.z())) return LongVector2::Constant(kInfinity);
    return (moved + 2.0L * moved.z() / height * (high - low)).head<2>();
  }

  /// The polygon but for what is too far away to weigh anything.
  std::vector<LongVector2> heavyPolygon() const {
    std::vector<LongVector2> polygon;
    for (const PlaneCut& cut : hull_) polygon.push_back(cut.point);
    for (int axis = 0; axis < 2; ++axis) {
      for (const long double sign : {-1.0L, 1.0L}) polygon = cutOff(polygon, axis, sign);
    }
    return polygon;
  }

  /// Where nothing of a side is that weighs anything.
  static bool isFarAway(const LongVector2& p, const LongVector2& q) {
    for (int axis = 0; axis < 2; ++axis) {
      if (std::min(p[axis], q[axis]) > kWidestSection) return true;
      if (std::max(p[axis], q[axis]) < -kWidestSection) return true;
    }
    return false;
  }

  /// How far the section may reach beyond the polygon, where it weighs anything, along ways from a
  /// centre: for every side, the share by which it does times the longest way to the side. So it is
  /// within a polygon whose corners are no farther than that.
  LongVector2 layerBeyond(const LongVector2& centre) const {
    if (!goesOnceAbout(hull_, centre)) return LongVector2::Constant(kInfinity);
    const LongVector2 heaviest = centre.cwiseAbs().array() + kWidestSection;
    LongVector2 layer = LongVector2::Zero();
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      const PlaneCut &first = hull_[k], &second = hull_[(k + 1) % hull_.size()];
      if (isFarAway(first.point, second.point)) continue;
      const LongVector2 farthest = (first.point - centre)
                                       .cwiseAbs()
                                       .cwiseMax((second.point - centre).cwiseAbs())
                                       .cwiseMin(heaviest);
      layer = layer.cwiseMax(1.001L * shareBeyond(first, second, centre) * farthest);
    }
    return layer;
  }

  static LongVector2 lesserOf(const LongVector2& p, const LongVector2& q) {
    return p.norm() <= q.norm() ? p : q;
  }

  /// Of the body's face that a side is in.
  static LongVector3 normalOf(const PlaneCut& first, const PlaneCut& second) {
    const LongVector2 side = second.point - first.point, normal(side.y(), -side.x());
    const LongVector3& edge =
        std::abs(first.edge.z()) > std::abs(second.edge.z()) ? first.edge : second.edge;
    return {normal.x(), normal.y(), -normal.dot(edge.head<2>()) / edge.z()};
  }

  /// How far the body reaches beyond a side, next to how far from it a point is.
  long double shareBeyond(const PlaneCut& first, const PlaneCut& second,
                          const LongVector2& centre) const {
    const LongVector3 normal = normalOf(first, second);
    const long double beyond =
        reachAlong(normal) - normal.head<2>().dot(first.point) +
        kCutRounding * normal.head<2>().cwiseAbs().dot(first.point.cwiseAbs());
    const long double depth = normal.head<2>().dot(first.point - centre);
    return depth > 0.0L ? std::max(0.0L, beyond) / depth : kInfinity;
  }

  /// Of a direction, the largest product with points of the body, rounding included.
  long double reachAlong(const LongVector3& direction) const {
    return body_.reach(direction) + direction.cwiseAbs().dot(rounding_ + slack_);
  }

  /// The first axis meets two sides of the polygon. Where it does is within the body but for what
  /// the polygon is off and what is lost on the way to the axis; and the plane through the body's
  /// face there tells where all of it ends.
  Bounds lineMass() const {
    LongVector2 low = hull_.front().point, high = low;
    for (const PlaneCut& cut : hull_) {
      low = low.cwiseMin(cut.point);
      high = high.cwiseMax(cut.point);
    }
    const LongVector2 layer = layerWithin();
    const long double height = std::min(high.y(), -low.y());
    if (!(height > kLeastHeight * layer.y())) return {0.0, 1.0};
    const long double moved = layer.x() + 2.0L * layer.y() / height * (high.x() - low.x());
    Bounds inner{kInfinity, -kInfinity}, outer{-kInfinity, kInfinity};
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      const PlaneCut &first = hull_[k], &second = hull_[(k + 1) % hull_.size()];
      const long double from = first.point.y(), to = second.point.y();
      if ((from < 0.0L) == (to < 0.0L)) continue;
      const long double end =
          first.point.x() + from / (from - to) * (second.point.x() - first.point.x());
      const LongVector3 normal = normalOf(first, second);
      const double limit = static_cast<double>(reachAlong(normal) / normal.x());
      if (normal.x() > 0.0L) {
        inner.upper = static_cast<double>(end - moved);
        outer.upper = limit + kEndOfLine * std::abs(limit);
      } else {
        inner.lower = static_cast<double>(end + moved);
        outer.lower = limit - kEndOfLine * std::abs(limit);
      }
    }
    inner.lower += kEndOfLine * std::abs(inner.lower);
    inner.upper -= kEndOfLine * std::abs(inner.upper);
    if (!(inner.lower <= inner.upper)) return {0.0, 1.0};
    const double rounding = 2.0 * kIntervalMassRelativeError;
    return {
        std::max(0.0, normalIntervalMass(inner.lower, inner.upper) * (1.0 - rounding) - kUnderflow),
        std::min(1.0,
                 normalIntervalMass(outer.lower, outer.upper) * (1.0 + rounding) + kUnderflow)};
  }

  static bool isSmall(const std::vector<LongVector2>& polygon) {
    return std::all_of(polygon.begin(), polygon.end(), [&](const LongVector2& p) {
      return (p - polygon.front()).norm() < kSmallSection;
    });
  }

  /// By cubature, in which nothing cancels.
  static Bounds massOfPrismOver(const std::vector<LongVector2>& polygon,
                                const Eigen::Vector2d& moved) {
    const int count = static_cast<int>(polygon.size());
    FaceSet prism;
    double farthest = 0.0;
    for (const double height : {-kPrismHalfWidth, kPrismHalfWidth}) {
      for (const LongVector2& p : polygon) {
        const Eigen::Vector2d corner = p.cast<double>();
        prism.addVertex({corner.x(), corner.y(), height});
        farthest = std::max(farthest, corner.norm());
      }
    }
    for (int k = 0; k < count; ++k) {
      const int next = (k + 1) % count;
      prism.addFace({k, next, count + next, count + k});
    }
    prism.beginFace();
    for (int k = count; k-- > 0;) prism.addCorner(k);
    prism.beginFace();
    for (int k = 0; k < count; ++k) prism.addCorner(count + k);
    const double error = moved.norm() + kEpsilon * farthest;
    const Bounds mass = polytopeMass(toClosedPolytope(prism), error, MassEffort{});
    const double rounding = 8.0 * kIntervalMassRelativeError;
    return {std::clamp(mass.lower / (prismMass(2) * (1.0 + rounding)), 0.0, 1.0),
            std::clamp(mass.upper / (prismMass(2) * (1.0 - rounding)) + kUnderflow, 0.0, 1.0)};
  }

  static Bounds massWithLayer(const std::vector<LongVector2>& polygon, const LongVector2& layer) {
    if (!(layer.maxCoeff() < kMostLayer)) return {0.0, 1.0};
    const Eigen::Vector2d moved = (layer * (1.0L + kEpsilon)).cast<double>();
    if (isSmall(polygon)) return massOfPrismOver(polygon, moved);
    Polygon2 image;
    Eigen::Vector2d reach = Eigen::Vector2d::Zero();
    for (const LongVector2& p : polygon) {
      image.push_back(p.cast<double>());
      reach = reach.cwiseMax(image.back().cwiseAbs());
    }
    const Bounds mass = polygonMass(image, moved + kEpsilon * reach);
    return {std::clamp(mass.lower, 0.0, 1.0), std::clamp(mass.upper + kUnderflow, 0.0, 1.0)};
  }

  LongMatrix3 map_;
  DifferenceBody body_;
  LongVector3 rounding_, slack_;  ///< along each axis
  LongPoints corners_;
  std::vector<PlaneCut> hull_;
};

}  // namespace

Bounds polytopeSectionMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                           const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                           const Interruption& interruption, double inset) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  if (!frame.fits || frame.rank < 1 || frame.rank > 2) return {0.0, 1.0};
  const WorldPair pair = worldPair(frame, a, pose_a, b, pose_b, displacement, inset);
  PolytopeSection section(frame, pair, displacement);
  if (section.misses()) return {0.0, 0.0};
  const auto summed = summedFaces(frame, a, b, interruption);
  if (!summed) return {0.0, 1.0};
  return section.mass(*summed, pair.origin, frame.rank == 1);
}

}  // namespace fcl_prob::detail
