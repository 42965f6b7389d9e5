// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/room_within.h"

#include <algorithm>
#include <array>

#include "base/constants.h"
#include "convex/convex_set.h"
#include "convex/cut_polytope.h"

namespace fcl_prob::detail {
namespace {

/// Of a height of a turned point, in units of kLongEpsilon of the size: two products of three terms
/// each, what the turn is rounded by, and the difference of two of them.
constexpr double kRoomRounding = 48.0;

/// By how many ε of the size planes are moved before they are cut with each other, which is rounded
/// by less; and so much that a room without height is no flat body.
constexpr std::array<long double, 4> kMovedPlanes{4.0L, 32.0L, 256.0L, 0x1p20L};

/// Rooms of more faces are not looked for.
constexpr std::size_t kMostSides = 1000;

using Points = std::vector<Eigen::Vector3d>;

long double heightAlong(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  return normal.cast<long double>().dot(point.cast<long double>());
}

Points cornersOfGuest(const ConvexBody& body) {
  const auto& rounded = body.set().rounded();
  return rounded ? rounded->core.corners() : body.set().outerMesh().vertices;
}

long double highestOf(const Points& points, const LongVector3& direction) {
  long double most = -kInfinity;
  for (const Eigen::Vector3d& p : points) {
    most = std::max(most, direction.dot(p.cast<long double>()));
  }
  return most;
}

long double lowestAlong(const ConvexMesh& mesh, const ConvexMesh::Face& face,
                        const Eigen::Vector3d& direction) {
  long double least = kInfinity;
  for (int c = 0; c < face.count; ++c) {
    const auto corner = static_cast<std::size_t>(mesh.corners[face.first + c]);
    least = std::min(least, heightAlong(direction, mesh.vertices[corner]));
  }
  return least;
}

Eigen::Vector3d middleOfVertices(const ConvexMesh& mesh) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : mesh.vertices) {
    middle += v / static_cast<double>(mesh.vertices.size());
  }
  return middle;
}

}  // namespace

RoomWithin::RoomWithin(const ConvexBody& host, const ConvexBody& guest, const LongMatrix3& turn,
                       double inset)
    : size_(host.set().size() + guest.set().size()),
      rounding_(kRoomRounding * static_cast<long double>(kLongEpsilon) * size_) {
  const ConvexMesh& of_host = host.set().outerMesh();
  const Points of_guest = cornersOfGuest(guest);
  const LongMatrix3 back = turn.transpose();
  const long double slack = host.set().slack() + guest.set().slack();
  const auto heightOfGuest = [&](const LongVector3& n) { return highestOf(of_guest, back * n); };
  const auto mostAlong = [&](const LongVector3& n) {
    return highestOf(of_host.vertices, n) - heightOfGuest(n) + slack + inset + rounding_;
  };
  const auto isTooWideAlong = [&](const LongVector3& n) {
    return mostAlong(n) + mostAlong(-n) < 0.0L;
  };
  for (const ConvexMesh::Face& face : of_host.faces) {
    const LongVector3 n = face.normal.cast<long double>();
    const long double least = lowestAlong(of_host, face, face.normal) - heightOfGuest(n);
    sides_.push_back({face.normal, mostAlong(n), least - slack - inset - rounding_});
    is_empty_ = is_empty_ || isTooWideAlong(n);
  }
  for (const ConvexMesh::Face& face : guest.set().outerMesh().faces) {
    is_empty_ = is_empty_ || isTooWideAlong(turn * face.normal.cast<long double>());
  }
}

/// Of the planes, each moved outwards or inwards.
Points RoomWithin::corners(bool around, long double moved) const {
  FaceSet faces;
  const double reach = powerOfTwoAt(4.0 * size_);
  setToBox(Eigen::Vector3d::Constant(-reach), Eigen::Vector3d::Constant(reach), faces);
  CutPolytope room(faces);
  for (const Side& side : sides_) {
    const long double limit = around ? side.most + moved : side.least - moved;
    room.cut(side.normal, static_cast<double>(limit));
  }
  room.writeTo(faces);
  return faces.faceCount() < 4 ? Points{} : faces.vertices();
}

/// On the way from the middle of the body to a place outside it, some face is passed: along the
/// normal of some side all its corners are higher than the middle and than the room, and what is
/// farther on the way is higher still.
bool RoomWithin::holdsRoom(const ConvexBody& body) const {
  const ConvexMesh& mesh = body.set().outerMesh();
  if (mesh.faces.size() < 4) return false;
  const Eigen::Vector3d middle = middleOfVertices(mesh);
  return std::all_of(mesh.faces.begin(), mesh.faces.end(), [&](const ConvexMesh::Face& face) {
    return std::any_of(sides_.begin(), sides_.end(), [&](const Side& side) {
      const long double least = lowestAlong(mesh, face, side.normal) - rounding_;
      return least > side.most && least > heightAlong(side.normal, middle);
    });
  });
}

bool RoomWithin::isRoom(const Points& points) const {
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
    return std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
      return heightAlong(side.normal, p) < side.least - rounding_;
    });
  });
}

std::optional<ConvexBody> RoomWithin::around() const {
  if (sides_.size() > kMostSides) return std::nullopt;
  for (const long double moved : kMovedPlanes) {
    const Points points = corners(true, moved * kEpsilon * size_);
    if (points.empty()) continue;
    ConvexBody body(points);
    if (holdsRoom(body)) return body;
  }
  return std::nullopt;
}

std::optional<ConvexBody> RoomWithin::inside() const {
  if (sides_.size() > kMostSides) return std::nullopt;
  for (const long double moved : kMovedPlanes) {
    const Points points = corners(false, moved * kEpsilon * size_);
    if (!points.empty() && isRoom(points)) return ConvexBody(points);
  }
  return std::nullopt;
}

}  // namespace fcl_prob::detail
