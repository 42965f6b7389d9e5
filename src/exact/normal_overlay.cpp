// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/normal_overlay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {
namespace {

using Vector = Eigen::Vector3d;
using LongNormal = Eigen::Matrix<long double, 3, 1>;

/// Angles that are nearer to each other are a tie; they are right to a few ε.
constexpr double kAngleTie = 1e-13;

/// Arcs turn no more than this about their axis, and no apex is farther from an end of the edge.
constexpr double kLongestTurn = 1.6;
constexpr double kWidestGap = 1.9;

/// On the edge of the half sphere, at an angle from the first axis towards the second.
struct OverlayNode {
  double angle;
  int node;
  int circle;  ///< that it is an end of, or -1
};

/// A piece of a region's boundary.
struct RegionPiece {
  int from, to;
  int circle;
};

class OverlayBuilder {
 public:
  explicit OverlayBuilder(const std::array<NormalCircle, 2>& circles) : circles_(circles) {
    const LongNormal a = circles[0].axis.cast<long double>().normalized(),
                     b = circles[1].axis.cast<long double>().normalized();
    north_ = a.cross(b).normalized();
    first_ = a;
    aside_ = north_.cross(a);
    along_ = {a.dot(b), b.dot(aside_)};
    angle_ = static_cast<double>(std::atan2(along_[1], along_[0]));
    is_square_ = std::abs(M_PI_2 - angle_) < kAxesTie;
    if (is_square_) angle_ = M_PI_2;
  }

  std::optional<NormalOverlay> build() {
    addEdgeNodes();
    if (!isClear() || !addCrossing()) return std::nullopt;
    for (const int k : {0, 1}) addArcs(k);
    std::vector<OverlayNode> ends;
    std::copy_if(edge_.begin(), edge_.end(), std::back_inserter(ends),
                 [](const OverlayNode& node) { return node.circle >= 0; });
    for (std::size_t k = 0; k < ends.size(); ++k) {
      OverlayNode to = ends[(k + 1) % ends.size()];
      if (k + 1 == ends.size()) to.angle += 2.0 * M_PI;
      addRegion(ends[k], to);
    }
    return std::move(overlay_);
  }

 private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  const NormalCircle& circle(int k) const { return circles_[index(k)]; }

  int addNode(const LongNormal& normal, bool on_edge, int pole = -1) {
    const Vector upper = normal.cast<double>();
    const LongNormal mirrored = normal - 2.0L * normal.dot(north_) * north_;
    overlay_.nodes.push_back({{upper, on_edge ? upper : Vector(mirrored.cast<double>())}, pole});
    return static_cast<int>(overlay_.nodes.size()) - 1;
  }

  LongNormal onEdge(double angle) const {
    const auto x = static_cast<long double>(angle);
    return std::cos(x) * first_ + std::sin(x) * aside_;
  }

  /// Where axes are perpendicular, and a circle is across its axis, it ends at poles of the other.
  bool endsAtPoles(int k) const { return is_square_ && circle(k).lift == 0.0; }

  void addEdgeNode(double angle, int circle, int pole) {
    const double whole = 2.0 * M_PI;
    const double from_zero = angle < 0.0 ? angle + whole : angle < whole ? angle : angle - whole;
    LongNormal normal = onEdge(angle);
    if (pole >= 0) {
      const LongNormal axis = this->circle(pole).axis.cast<long double>();
      normal = normal.dot(axis) > 0.0L ? axis : LongNormal(-axis);
    }
    edge_.push_back({from_zero, addNode(normal, true, pole), circle});
  }

  void addEdgeNodes() {
    for (const int k : {0, 1}) {
      const double axis = k == 0 ? 0.0 : angle_;
      const int circle_of_poles = endsAtPoles(1 - k) ? 1 - k : -1;
      addEdgeNode(axis, circle_of_poles, k);
      addEdgeNode(axis + M_PI, circle_of_poles, k);
      if (endsAtPoles(k)) continue;
      const double away = std::atan2(circle(k).cosine, circle(k).lift);
      addEdgeNode(axis + away, k, -1);
      addEdgeNode(axis - away, k, -1);
    }
    std::sort(edge_.begin(), edge_.end(),
              [](const OverlayNode& x, const OverlayNode& y) { return x.angle < y.angle; });
  }

  bool isClear() const {
    for (std::size_t k = 0; k < edge_.size(); ++k) {
      const bool last = k + 1 == edge_.size();
      const double next = last ? edge_[0].angle + 2.0 * M_PI : edge_[k + 1].angle;
      if (!(next - edge_[k].angle > kAngleTie)) return false;
    }
    return true;
  }

  /// Circles meet if their ends on the edge alternate: at n·A and n·B as they are to be, |n| = 1.
  bool addCrossing() {
    std::vector<int> order;
    for (const OverlayNode& node : edge_) {
      if (node.circle >= 0) order.push_back(node.circle);
    }
    if (order[0] == order[1] || order[1] == order[2]) return true;
    const auto along = static_cast<long double>(circle(0).lift);
    const long double aside =
        (static_cast<long double>(circle(1).lift) - along * along_[0]) / along_[1];
    const long double square = 1.0L - along * along - aside * aside;
    if (!(square > kAngleTie)) return false;
    overlay_.crossing =
        addNode(along * first_ + aside * aside_ + std::sqrt(square) * north_, false);
    return true;
  }

  /// Across the axis, towards where the circle begins on the edge.
  LongNormal sideways(int k) const {
    return north_.cross(circle(k).axis.cast<long double>()).normalized();
  }

  LongNormal onCircle(int k, double turn) const {
    const auto x = static_cast<long double>(turn);
    return static_cast<long double>(circle(k).lift) * circle(k).axis.cast<long double>() +
           static_cast<long double>(circle(k).cosine) *
               (std::cos(x) * sideways(k) + std::sin(x) * north_);
  }

  /// The end of a circle on the edge: the first one if `sign` is 1.
  int endOf(int k, double sign) const {
    for (const OverlayNode& node : edge_) {
      const LongNormal normal = overlay_.normal(node.node, 0).cast<long double>();
      if (node.circle == k && normal.dot(sideways(k)) * sign > 0.0L) return node.node;
    }
    return -1;
  }

  void addArcs(int k) {
    double middle = M_PI_2;
    int crossing = -1;
    if (overlay_.crossing) {
      crossing = *overlay_.crossing;
      const LongNormal normal = overlay_.normal(crossing, 0).cast<long double>();
      middle = static_cast<double>(std::atan2(normal.dot(north_), normal.dot(sideways(k))));
    } else {
      crossing = addNode(onCircle(k, M_PI_2), false);
    }
    auto& nodes = along_circle_[index(k)];
    nodes.push_back(endOf(k, 1.0));
    addArcsBetween(k, 0.0, middle, crossing);
    middle_[index(k)] = nodes.size() - 1;
    addArcsBetween(k, middle, M_PI, endOf(k, -1.0));
  }

  void addArcsBetween(int k, double from, double to, int last) {
    auto& nodes = along_circle_[index(k)];
    const int count = std::max(1, static_cast<int>(std::ceil((to - from) / kLongestTurn)));
    for (int i = 1; i <= count; ++i) {
      const double begin = from + (to - from) * (i - 1) / count;
      const double end = from + (to - from) * i / count;
      const int node = i == count ? last : addNode(onCircle(k, end), false);
      const Vector between = onCircle(k, 0.5 * (begin + end)).cast<double>();
      overlay_.arcs.push_back({k, nodes.back(), node, isAbove(1 - k, between)});
      nodes.push_back(node);
    }
  }

  bool isAbove(int k, const Vector& normal) const {
    return normal.dot(circle(k).axis) > circle(k).lift;
  }

  /// From one node of a circle to another, by their places along it.
  void addPieces(int k, std::size_t from, std::size_t to, std::vector<RegionPiece>& pieces) const {
    const auto& nodes = along_circle_[index(k)];
    for (std::size_t i = from; i != to;) {
      const std::size_t next = from < to ? i + 1 : i - 1;
      pieces.push_back({nodes[i], nodes[next], k});
      i = next;
    }
  }

  std::size_t placeOf(const OverlayNode& end) const {
    const auto& nodes = along_circle_[index(end.circle)];
    return nodes.front() == end.node ? 0 : nodes.size() - 1;
  }

  /// From one end of a circle on the edge to the next one. What is above the edge: back along the
  /// circles.
  void addRegion(const OverlayNode& from, const OverlayNode& to) {
    std::vector<RegionPiece> pieces;
    const std::size_t middle_from = middle_[index(from.circle)],
                      middle_to = middle_[index(to.circle)];
    addPieces(to.circle, placeOf(to), middle_to, pieces);
    const std::size_t turn = pieces.size();
    const int first = along_circle_[index(to.circle)][middle_to],
              last = along_circle_[index(from.circle)][middle_from];
    if (first != last) pieces.push_back({first, last, -1});
    addPieces(from.circle, middle_from, placeOf(from), pieces);
    const Vector within = onEdge(0.5 * (from.angle + to.angle)).cast<double>();
    addFans(apexesBetween(from, to), pieces, turn, {isAbove(0, within), isAbove(1, within)});
  }

  /// Poles, ends included, with nodes between two of them and where gaps are wide; at least one.
  std::vector<int> apexesBetween(const OverlayNode& from, const OverlayNode& to) {
    std::vector<OverlayNode> poles;
    for (const double turn : {0.0, 2.0 * M_PI}) {
      for (OverlayNode node : edge_) {
        node.angle += turn;
        if (overlay_.poleAt(node.node) >= 0 && node.angle >= from.angle && node.angle <= to.angle) {
          poles.push_back(node);
        }
      }
    }
    const auto between = [&](double x, double y) { return addNode(onEdge(0.5 * (x + y)), true); };
    if (poles.empty()) return {between(from.angle, to.angle)};
    std::vector<int> apexes;
    if (poles.front().angle - from.angle > kWidestGap) {
      apexes.push_back(between(from.angle, poles.front().angle));
    }
    for (std::size_t k = 0; k < poles.size(); ++k) {
      if (k > 0) apexes.push_back(between(poles[k - 1].angle, poles[k].angle));
      apexes.push_back(poles[k].node);
    }
    if (to.angle - poles.back().angle > kWidestGap) {
      apexes.push_back(between(poles.back().angle, to.angle));
    }
    return apexes;
  }

  /// The last apex has the pieces up to the turn, the first one those after it, others triangles
  /// with the node at the turn.
  void addFans(const std::vector<int>& apexes, const std::vector<RegionPiece>& pieces,
               std::size_t turn, const std::array<bool, 2>& above) {
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const int apex = k < turn ? apexes.back() : apexes.front();
      const RegionPiece& piece = pieces[k];
      const int pole = overlay_.poleAt(apex);
      // Of a circle through the apex there is nothing between them.
      if (piece.circle >= 0 && pole == 1 - piece.circle && endsAtPoles(piece.circle)) continue;
      overlay_.triangles.push_back({piece.from, piece.to, apex, piece.circle, above});
    }
    const int top = turn > 0 ? pieces[turn - 1].to : pieces[0].from;
    for (std::size_t k = 0; k + 1 < apexes.size(); ++k) {
      const int left = apexes[k], right = apexes[k + 1];
      if (overlay_.poleAt(right) >= 0) {
        overlay_.triangles.push_back({top, left, right, -1, above});
      } else {
        overlay_.triangles.push_back({right, top, left, -1, above});
      }
    }
  }

  const std::array<NormalCircle, 2>& circles_;
  LongNormal first_, aside_, north_;  ///< unit: along A, across that towards B, along A × B
  std::array<long double, 2> along_;  ///< B along the first two
  double angle_;                      ///< from A to B
  bool is_square_;
  std::vector<OverlayNode> edge_;
  std::array<std::vector<int>, 2> along_circle_;  ///< nodes, from one end to the other
  std::array<std::size_t, 2> middle_{};           ///< the place of the crossing or middle there
  NormalOverlay overlay_;
};

}  // namespace

std::optional<NormalOverlay> normalOverlay(const std::array<NormalCircle, 2>& circles) {
  return OverlayBuilder(circles).build();
}

}  // namespace fcl_prob::detail
