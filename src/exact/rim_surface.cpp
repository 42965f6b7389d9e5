// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/rim_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

using Vector = Eigen::Vector3d;

/// What is nearer to the axis, the circle or another corner's height than this, relative to 1 or
/// the size, is a tie.
constexpr double kTie = 1e-13;

/// Every normal is tried on every corner.
constexpr std::size_t kMostRimFaces = 2000;

/// By how much turns around a corner may be off whole ones.
constexpr double kTurnError = 1e-4;

/// Between the corners of an arc of normals a defect may be this much larger than at them.
constexpr double kDefectBetween = 3.0;

enum class End { bottom, top };

/// A normal and where the rim is along it.
struct RimNormal {
  Vector normal;
  Vector rim;  ///< unit, across the axis
  End end;
};

/// Where the circle of the side's normals leaves the cell of one corner for that of another, walked
/// anticlockwise about the axis.
struct Cut {
  Vector rim;
  double angle;
  int from, to;
};

double angleOf(const Vector& rim) { return std::atan2(rim.y(), rim.x()); }

/// From one direction across the axis to another, the short way.
double turnBetween(const Vector& from, const Vector& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

Vector rotated(const Vector& rim, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * rim.x() - s * rim.y(), s * rim.x() + c * rim.y(), 0.0};
}

/// Of n/|n| above the circle.
double heightOf(const Vector& normal, double lift) { return normal.z() - lift * normal.norm(); }

double radiusOf(const Frustum& frustum, End end) {
  return end == End::top ? frustum.top : frustum.bottom;
}

class RimSurfaceBuilder {
 public:
  RimSurfaceBuilder(const CurvedSum& sum, const ConvexMesh& polytope)
      : sum_(sum), mesh_(polytope), frustum_(sum.frustum), frame_(sum.map * sum.frame) {
    const double rise = 2.0 * frustum_.half_height, narrowing = frustum_.bottom - frustum_.top;
    lift_ = narrowing / std::hypot(rise, narrowing);
    image_.setZero();
    image_.leftCols<2>() = frame_.leftCols<2>().cast<double>();
    for (const Vector& v : mesh_.vertices) {
      size_ = std::max(size_, (v - mesh_.vertices[0]).norm());
    }
    top_turn_.assign(mesh_.vertices.size(), 0.0);
    bottom_turn_.assign(mesh_.vertices.size(), 0.0);
  }

  std::optional<RimSurface> build() {
    if (mesh_.faces.empty() || mesh_.faces.size() > kMostRimFaces || !(size_ > 0.0)) {
      return std::nullopt;
    }
    for (const ConvexMesh::Face& face : mesh_.faces) {
      const auto normal = rimNormal(face.normal);
      if (!normal) return std::nullopt;
      faces_.push_back(*normal);
      measureFace(face);
      addFace(face, *normal);
    }
    for (const ConvexMesh::Edge& edge : mesh_.edges) {
      if (!addEdge(edge)) return std::nullopt;
    }
    if (!addSides() || !addDisc(End::top) || !addDisc(End::bottom) || !closes()) {
      return std::nullopt;
    }
    result_.defect = kDefectBetween * defect_;
    return std::move(result_);
  }

 private:
  const Vector& at(int vertex) const { return mesh_.vertices[static_cast<std::size_t>(vertex)]; }

  /// A corner of the polytope at an end of the axis, mapped.
  Vector position(int vertex, End end) const {
    LongVector3 point = at(vertex).cast<long double>();
    point.z() += (end == End::top ? 1.0L : -1.0L) * frustum_.half_height;
    return (sum_.centre() + frame_ * point).cast<double>();
  }

  std::optional<RimNormal> rimNormal(const Vector& normal) const {
    const Vector across(normal.x(), normal.y(), 0.0);
    const double height = heightOf(normal, lift_);
    if (!(across.norm() > kTie) || !(std::abs(height) > kTie)) return std::nullopt;
    return RimNormal{normal, across.normalized(), height > 0.0 ? End::top : End::bottom};
  }

  /// How far the polytope reaches beyond the plane through a point.
  void measure(const Vector& normal, const Vector& point) {
    for (const Vector& v : mesh_.vertices) defect_ = std::max(defect_, normal.dot(v - point));
  }
  void measureFace(const ConvexMesh::Face& face) {
    for (int k = 0; k < face.count; ++k) {
      measure(face.normal, at(mesh_.corners[static_cast<std::size_t>(face.first + k)]));
    }
  }

  CurvedTerm rimTerm(const Vector& from, const Vector& to, double first, double second) const {
    CurvedTerm term{image_, {from, to, from, to}};
    term.size = {first, second};
    return term;
  }

  void addFace(const ConvexMesh::Face& face, const RimNormal& normal) {
    const auto corner = [&](int k) {
      return position(mesh_.corners[static_cast<std::size_t>(face.first + k)], normal.end);
    };
    for (int k = 1; k + 1 < face.count; ++k) {
      SurfacePatch patch;
      // At t = 0 all of it is one corner.
      patch.position = {corner(0), corner(0), corner(k), corner(k + 1)};
      std::swap(patch.position[2], patch.position[3]);
      if (radiusOf(frustum_, normal.end) > 0.0) {
        patch.add(rimTerm(normal.rim, normal.rim, radiusOf(frustum_, normal.end),
                          radiusOf(frustum_, normal.end)));
      }
      result_.patches.push_back(patch);
    }
  }

  /// From the normal of the face on its left to that of the face on its right, by way of one in
  /// between.
  bool addEdge(const ConvexMesh::Edge& edge) {
    if (edge.left < 0 || edge.right < 0) return false;
    const RimNormal &first = faces_[static_cast<std::size_t>(edge.left)],
                    &last = faces_[static_cast<std::size_t>(edge.right)];
    const Vector along = at(edge.to) - at(edge.from);
    const Vector middle =
        (along.cross(first.normal).stableNormalized() + last.normal.cross(along).stableNormalized())
            .stableNormalized();
    const auto between = rimNormal(middle);
    if (!between) return false;
    if (!(middle.dot(first.normal) > -0.3) || !(middle.dot(last.normal) > -0.3)) return false;
    measure(middle, at(edge.from));
    measure(middle, at(edge.to));
    return addArc(edge, first, *between) && addArc(edge, *between, last);
  }

  bool addArc(const ConvexMesh::Edge& edge, const RimNormal& first, const RimNormal& last) {
    const std::vector<double> cuts = cutsOf(first.normal, last.normal);
    const bool crosses = first.end != last.end;
    if (cuts.size() > 2 || crosses != (cuts.size() == 1)) return false;
    RimNormal from = first;
    for (const double share : cuts) {
      const Vector normal = (1.0 - share) * first.normal + share * last.normal;
      const Vector across(normal.x(), normal.y(), 0.0);
      if (!(across.norm() > kTie)) return false;
      RimNormal to{normal, across.normalized(), from.end};
      addSwept(edge, from, to);
      addCut(edge, to.rim, from.end == End::bottom);
      to.end = from.end == End::bottom ? End::top : End::bottom;
      from = to;
    }
    if (from.end != last.end) return false;
    addSwept(edge, from, last);
    return true;
  }

  /// Where an arc between normals meets the circle: n_z² = lift² n·n, n_z of the sign of lift.
  std::vector<double> cutsOf(const Vector& first, const Vector& last) const {
    std::vector<double> cuts;
    const Vector step = last - first;
    const auto add = [&](double share) {
      if (!(share > 0.0 && share < 1.0)) return;
      const double z = first.z() + share * step.z();
      if (lift_ == 0.0 || z * lift_ > 0.0) cuts.push_back(share);
    };
    if (lift_ == 0.0) {
      if (first.z() * last.z() < 0.0) add(first.z() / (first.z() - last.z()));
      return cuts;
    }
    const double square = lift_ * lift_;
    const double a = step.z() * step.z() - square * step.squaredNorm();
    const double b = first.z() * step.z() - square * first.dot(step);
    const double c = first.z() * first.z() - square * first.squaredNorm();
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0.0)) return cuts;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0.0) add(q / a);
    if (q != 0.0) add(c / q);
    std::sort(cuts.begin(), cuts.end());
    return cuts;
  }

  /// Pieces of less than a quarter of a turn.
  template <class Add>
  void forEachPiece(const Vector& from, const Vector& to, double turn, const Add& add) {
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / 1.6)));
    Vector begin = from;
    for (int k = 1; k <= count; ++k) {
      const Vector end = k == count ? to : rotated(from, turn * k / count);
      add(begin, end);
      begin = end;
    }
  }

  void addSwept(const ConvexMesh::Edge& edge, const RimNormal& from, const RimNormal& to) {
    const double turn = turnBetween(from.rim, to.rim);
    auto& turns = from.end == End::top ? top_turn_ : bottom_turn_;
    turns[static_cast<std::size_t>(edge.to)] += turn;
    turns[static_cast<std::size_t>(edge.from)] -= turn;
    const double radius = radiusOf(frustum_, from.end);
    if (!(radius > 0.0) || turn == 0.0) return;
    forEachPiece(from.rim, to.rim, turn, [&](const Vector& begin, const Vector& end) {
      SurfacePatch patch;
      const Vector first = position(edge.from, from.end), second = position(edge.to, from.end);
      patch.position = {first, first, second, second};
      patch.add(rimTerm(begin, end, radius, radius));
      result_.patches.push_back(patch);
    });
  }

  /// A parallelogram of the edge and a segment of the side. An arc that goes upwards is crossed,
  /// anticlockwise, from the corner that the edge is walked to.
  void addCut(const ConvexMesh::Edge& edge, const Vector& rim, bool upwards) {
    const int from = upwards ? edge.to : edge.from, to = upwards ? edge.from : edge.to;
    cuts_.push_back({rim, angleOf(rim), from, to});
    SurfacePatch patch;
    patch.position = {position(from, End::bottom), position(to, End::bottom),
                      position(from, End::top), position(to, End::top)};
    patch.add(rimTerm(rim, rim, frustum_.bottom, frustum_.top));
    result_.patches.push_back(patch);
  }

  bool addSides() {
    if (cuts_.empty()) return addWholeSide();
    std::sort(cuts_.begin(), cuts_.end(),
              [](const Cut& a, const Cut& b) { return a.angle < b.angle; });
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      const Cut &cut = cuts_[k], &next = cuts_[(k + 1) % cuts_.size()];
      if (cut.to != next.from) return false;
      double turn = next.angle - cut.angle;
      if (k + 1 == cuts_.size()) turn += 2.0 * M_PI;
      addSide(cut.to, cut.rim, next.rim, turn);
    }
    return true;
  }

  bool addWholeSide() {
    const double across = std::sqrt(std::max(0.0, 1.0 - lift_ * lift_));
    const Vector normal(across, 0.0, lift_);
    int vertex = 0;
    for (int v = 1; v < static_cast<int>(mesh_.vertices.size()); ++v) {
      if (normal.dot(at(v) - at(vertex)) > 0.0) vertex = v;
    }
    addSide(vertex, Vector::UnitX(), Vector::UnitX(), 2.0 * M_PI);
    return true;
  }

  void addSide(int vertex, const Vector& from, const Vector& to, double turn) {
    // Seen from above the rim turns as the circle does, seen from below the other way.
    top_turn_[static_cast<std::size_t>(vertex)] += turn;
    bottom_turn_[static_cast<std::size_t>(vertex)] -= turn;
    forEachPiece(from, to, turn, [&](const Vector& begin, const Vector& end) {
      SurfacePatch patch;
      const Vector bottom = position(vertex, End::bottom), top = position(vertex, End::top);
      patch.position = {bottom, bottom, top, top};
      patch.add(rimTerm(begin, end, frustum_.bottom, frustum_.top));
      result_.patches.push_back(patch);
    });
  }

  /// The corner that is farthest along the axis; none if there are two.
  std::optional<int> farthestCorner(End end) const {
    const double sign = end == End::top ? 1.0 : -1.0;
    int best = 0;
    for (int v = 1; v < static_cast<int>(mesh_.vertices.size()); ++v) {
      if (sign * (at(v).z() - at(best).z()) > 0.0) best = v;
    }
    for (int v = 0; v < static_cast<int>(mesh_.vertices.size()); ++v) {
      if (v != best && sign * (at(best).z() - at(v).z()) <= kTie * size_) return std::nullopt;
    }
    return best;
  }

  bool addDisc(End end) {
    const auto vertex = farthestCorner(end);
    if (!vertex) return false;
    (end == End::top ? top_ : bottom_) = *vertex;
    const double radius = radiusOf(frustum_, end);
    if (!(radius > 0.0)) return true;
    forEachPiece(Vector::UnitX(), Vector::UnitX(), 2.0 * M_PI,
                 [&](const Vector& from, const Vector& to) {
                   SurfacePatch patch;
                   patch.position.fill(position(*vertex, end));
                   const bool outwards = end == End::bottom;
                   patch.add(rimTerm(from, to, outwards ? 0.0 : radius, outwards ? radius : 0.0));
                   result_.patches.push_back(patch);
                 });
    return true;
  }

  bool closes() const {
    for (int v = 0; v < static_cast<int>(mesh_.vertices.size()); ++v) {
      const auto k = static_cast<std::size_t>(v);
      if (!turnsTo(top_turn_[k], v == top_ ? 1.0 : 0.0)) return false;
      if (!turnsTo(bottom_turn_[k], v == bottom_ ? -1.0 : 0.0)) return false;
    }
    return true;
  }
  static bool turnsTo(double turn, double whole) {
    return std::abs(turn - whole * 2.0 * M_PI) <= kTurnError;
  }

  const CurvedSum& sum_;
  const ConvexMesh& mesh_;
  const Frustum& frustum_;
  LongMatrix3 frame_;
  Eigen::Matrix3d image_;
  double lift_ = 0.0, size_ = 0.0, defect_ = 0.0;
  std::vector<RimNormal> faces_;
  std::vector<Cut> cuts_;
  std::vector<double> top_turn_, bottom_turn_;  ///< of the rim, around the cell of each corner
  int top_ = 0, bottom_ = 0;
  RimSurface result_;
};

}  // namespace

std::optional<RimSurface> rimSurface(const CurvedSum& sum, const ConvexMesh& polytope) {
  return RimSurfaceBuilder(sum, polytope).build();
}

}  // namespace fcl_prob::detail
