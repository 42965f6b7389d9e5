// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/polytope_boundary.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/constants.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "geometry/directed_edges.h"
#include "geometry/ray_crossing.h"

namespace fcl_prob::detail {
namespace {

// Rounding of a point's place in a face's frame, in units of its distance: 1.5 kEpsilon for each of
// three coordinates, and axes that are orthonormal to an ulp or two.
constexpr double kFrameRounding = 5 * kEpsilon;

// Rounding of a position along an edge or of an inset, in units of the distance from the foot.
constexpr double kEdgeRounding = 4 * kEpsilon;

double cross(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  return p.x() * q.y() - p.y() * q.x();
}

void requireValid(const ConvexPolytope& polytope) {
  const int count = static_cast<int>(polytope.vertices.size());
  for (const Eigen::Vector3d& vertex : polytope.vertices) {
    if (!vertex.allFinite()) {
      throw InvalidGeometry("vertex of a polytope is not finite: " + numberText(vertex));
    }
  }
  for (const ConvexPolytope::Face& face : polytope.faces) {
    if (!(std::abs(face.normal.squaredNorm() - 1) < 1e-9)) {
      throw InvalidGeometry("normal of a polytope's face is not a unit vector: " +
                            numberText(face.normal));
    }
    if (face.vertices.size() < 3) throw InvalidGeometry("face of a polytope has no area");
    for (const int index : face.vertices) {
      if (index < 0 || index >= count) {
        throw InvalidGeometry("vertex index of a polytope's face is out of range: " +
                              std::to_string(index));
      }
    }
  }
}

Eigen::Vector3d longestSide(const ConvexPolytope& polytope, const std::vector<int>& loop) {
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector3d side =
        polytope.vertices[loop[(k + 1) % loop.size()]] - polytope.vertices[loop[k]];
    if (side.squaredNorm() > longest.squaredNorm()) longest = side;
  }
  return longest;
}

void setAxes(FaceFrame& frame, const Eigen::Vector3d& normal, const Eigen::Vector3d& along) {
  frame.normal = normal.normalized();
  const Eigen::Vector3d in_plane = along - frame.normal * frame.normal.dot(along);
  const bool has_direction = in_plane.stableNorm() > 0;
  frame.a = has_direction ? Eigen::Vector3d(in_plane.stableNormalized())
                          : Eigen::Vector3d(frame.normal.unitOrthogonal());
  // Once more: the first pass leaves rounding of the size of `along`.
  frame.a = (frame.a - frame.normal * frame.normal.dot(frame.a)).normalized();
  frame.b = frame.normal.cross(frame.a);
}

void setHeight(FaceFrame& frame, const ConvexPolytope& polytope, const std::vector<int>& loop) {
  const auto nearer = [&](int i, int j) {
    return polytope.vertices[i].squaredNorm() < polytope.vertices[j].squaredNorm();
  };
  const Eigen::Vector3d& nearest =
      polytope.vertices[*std::min_element(loop.begin(), loop.end(), nearer)];
  frame.height = frame.normal.dot(nearest);
  double largest = 0, below = 0, above = 0;
  for (const int index : loop) {
    const Eigen::Vector3d& vertex = polytope.vertices[index];
    const double offset = frame.normal.dot(vertex - nearest);
    below = std::min(below, offset);
    above = std::max(above, offset);
    largest = std::max(largest, vertex.norm());
  }
  frame.deviation = std::max(above, -below) + kFrameRounding * largest;
  frame.unevenness = loop.size() > 3 ? above - below : 0.0;
}

FaceFrame faceFrame(const ConvexPolytope& polytope, const ConvexPolytope::Face& face) {
  FaceFrame frame;
  frame.contour_distance = std::numeric_limits<double>::infinity();
  setAxes(frame, face.normal, longestSide(polytope, face.vertices));
  setHeight(frame, polytope, face.vertices);
  frame.lo = frame.hi = frame.coordinates(polytope.vertices[face.vertices[0]]);
  for (const int index : face.vertices) {
    const Eigen::Vector2d q = frame.coordinates(polytope.vertices[index]);
    frame.lo = frame.lo.cwiseMin(q);
    frame.hi = frame.hi.cwiseMax(q);
  }
  return frame;
}

// `from` and `to` are the ends of the edge as the shared parametrisation runs; `sign` is -1 if the
// face walks it the other way round.
EdgeSide edgeSide(const FaceFrame& frame, int face, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to, double sign, const BoundaryEdge& edge) {
  const Eigen::Vector2d p = frame.coordinates(from);
  const Eigen::Vector2d q = frame.coordinates(to);
  const Eigen::Vector2d step = q - p;
  const double length = step.norm();
  EdgeSide side;
  side.face = face;
  if (length == 0) return side;
  const Eigen::Vector2d& near = p.squaredNorm() < q.squaredNorm() ? p : q;
  side.inset = sign * cross(near, step) / length;
  side.t_from = p.dot(step) / length;
  side.t_to = q.dot(step) / length;
  side.mismatch =
      std::abs(frame.height * frame.height + side.inset * side.inset - edge.distance_squared);
  side.inset_error = kEdgeRounding * near.norm();
  side.from_error = std::abs(side.t_from - edge.t_from) + kEdgeRounding * p.norm();
  side.to_error = std::abs(side.t_to - edge.t_to) + kEdgeRounding * q.norm();
  return side;
}

BoundaryEdge boundaryEdge(const ConvexPolytope& polytope, const std::vector<FaceFrame>& faces,
                          const EdgeMatch& match) {
  const Eigen::Vector3d& from = polytope.vertices[match.forward.from];
  const Eigen::Vector3d& to = polytope.vertices[match.forward.to];
  const Eigen::Vector3d along = (to - from).stableNormalized();
  const Eigen::Vector3d& near = from.squaredNorm() < to.squaredNorm() ? from : to;
  BoundaryEdge edge;
  edge.t_from = along.dot(from);
  edge.t_to = along.dot(to);
  edge.distance_squared = (near - along * along.dot(near)).squaredNorm();
  const int first = match.forward.polygon;
  const int second = match.backward.polygon;
  edge.sides[0] = edgeSide(faces[first], first, from, to, 1, edge);
  edge.sides[1] = edgeSide(faces[second], second, from, to, -1, edge);
  return edge;
}

// Least t² between two positions.
double leastSquareBetween(double from, double to) {
  const double t = std::clamp(0.0, from, std::max(from, to));
  return t * t;
}

double distanceToEdge(const BoundaryEdge& edge) {
  return std::sqrt(edge.distance_squared + leastSquareBetween(edge.t_from, edge.t_to));
}

// In deep tails an angle that is nearly 0 must be exactly 0. It is neither 0 nor 2π only if the
// foot is a vertex, whose own sides then have no angle.
double roundedAngle(double angle) {
  const double whole = 2 * M_PI * std::round(angle / (2 * M_PI));
  return std::abs(angle - whole) < 1e-6 ? whole : angle;
}

void addSides(const ConvexPolytope& polytope, const EdgeMatch& match, PolytopeBoundary& boundary) {
  const BoundaryEdge& edge =
      boundary.edges.emplace_back(boundaryEdge(polytope, boundary.faces, match));
  boundary.distance = std::min(boundary.distance, distanceToEdge(edge));
  for (const EdgeSide& side : edge.sides) {
    FaceFrame& face = boundary.faces[static_cast<std::size_t>(side.face)];
    face.angle += angleBetween(side.inset, side.t_from, side.t_to);
    face.contour_distance = std::min(face.contour_distance, footDistance(side));
  }
}

void finishFaces(PolytopeBoundary& boundary) {
  for (FaceFrame& face : boundary.faces) {
    face.angle = roundedAngle(face.angle);
    if (face.angle != 0) boundary.distance = std::min(boundary.distance, std::abs(face.height));
  }
}

// Whether a ray from the origin crosses the faces an odd number of times, if it is nowhere too
// close to an edge to tell. Heights of faces do not tell: the normals of slivers are noise. The
// rays are along no direction that bodies are symmetric about.
std::optional<bool> isAroundOrigin(const ConvexPolytope& polytope) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(0.83, 0.31, -0.37, 0.28).normalized().toRotationMatrix();
  std::vector<Eigen::Vector3d> turned;
  double reach = 0.0;
  for (const Eigen::Vector3d& v : polytope.vertices) {
    turned.emplace_back(turn * v);
    reach = std::max(reach, v.lpNorm<1>());
  }
  const double margin = 8 * kEpsilon * reach;  // of three products and the entries of the turn
  const auto alongAxis = [&](int axis) -> std::optional<bool> {
    bool odd = false;
    for (const ConvexPolytope::Face& face : polytope.faces) {
      const auto corner = [&](std::size_t k) { return turned[face.vertices[k]]; };
      for (std::size_t k = 2; k < face.vertices.size(); ++k) {
        const auto crossing = rayCrossing({corner(0), corner(k - 1), corner(k)}, axis, margin);
        if (!crossing) return std::nullopt;
        odd = odd != (*crossing != 0);
      }
    }
    return odd;
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto odd = alongAxis(axis)) return odd;
  }
  return std::nullopt;
}

}  // namespace

double angleBetween(double inset, double t_from, double t_to) {
  // So that a side through the foot may be divided at the foot.
  const double nonzero = std::copysign(std::max(std::abs(inset), 1e-300), inset);
  return std::atan2(nonzero * (t_to - t_from), inset * inset + t_from * t_to);
}

double footDistance(const EdgeSide& side) {
  return std::sqrt(side.inset * side.inset + leastSquareBetween(side.t_from, side.t_to));
}

PolytopeBoundary polytopeBoundary(const ConvexPolytope& polytope) {
  requireValid(polytope);
  PolytopeBoundary boundary;
  boundary.distance = std::numeric_limits<double>::infinity();
  std::vector<DirectedEdge> walked;
  for (const ConvexPolytope::Face& face : polytope.faces) {
    const int index = static_cast<int>(boundary.faces.size());
    boundary.faces.push_back(faceFrame(polytope, face));
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      walked.push_back({face.vertices[k], face.vertices[(k + 1) % face.vertices.size()], index});
    }
  }
  const EdgePairing pairing = pairEdges(std::move(walked));
  if (pairing.fault) throw InvalidGeometry("faces of a polytope do not close: " + *pairing.fault);
  boundary.edges.reserve(pairing.matches.size());
  for (const EdgeMatch& match : pairing.matches) addSides(polytope, match, boundary);
  finishFaces(boundary);
  boundary.origin_inside = isAroundOrigin(polytope);
  return boundary;
}

}  // namespace fcl_prob::detail
