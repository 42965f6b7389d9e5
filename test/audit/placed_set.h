// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A scene's objects as convex pieces in the world, in any arithmetic.
#pragma once

#include <numeric>
#include <optional>

#include "line_contact.h"
#include "scene.h"

namespace fcl_prob_audit {

template <typename Real>
Vec<Real> toVec(const Vector3d& v) {
  return {Real(v[0]), Real(v[1]), Real(v[2])};
}

/// The pose as it is, even if it is not quite a rotation.
template <typename Real>
Vec<Real> placed(const fcl::Transform3d& pose, const Vec<Real>& p) {
  const auto row = [&](int i) {
    return Real(Real(pose(i, 0)) * p.x + Real(pose(i, 1)) * p.y + Real(pose(i, 2)) * p.z +
                Real(pose(i, 3)));
  };
  return {row(0), row(1), row(2)};
}

template <typename Real>
Vec<Real> turned(const fcl::Transform3d& pose, const Vec<Real>& p) {
  const auto row = [&](int i) {
    return Real(Real(pose(i, 0)) * p.x + Real(pose(i, 1)) * p.y + Real(pose(i, 2)) * p.z);
  };
  return {row(0), row(1), row(2)};
}

template <typename Real>
Piece<Real> boxPiece(const Vec<Real>& lo, const Vec<Real>& hi, const fcl::Transform3d& pose) {
  Piece<Real> piece;
  for (int corner = 0; corner < 8; ++corner) {
    piece.points.push_back(placed<Real>(
        pose,
        {(corner & 1) ? hi.x : lo.x, (corner & 2) ? hi.y : lo.y, (corner & 4) ? hi.z : lo.z}));
  }
  for (int k = 0; k < 3; ++k) {
    piece.edges.push_back(turned<Real>(pose, {Real(k == 0), Real(k == 1), Real(k == 2)}));
  }
  return piece;
}

template <typename Real>
Piece<Real> trianglePiece(const std::array<Vec<Real>, 3>& corners) {
  Piece<Real> piece;
  for (std::size_t k = 0; k < 3; ++k) {
    piece.points.push_back(corners[k]);
    const Vec<Real> edge = corners[(k + 1) % 3] - corners[k];
    if (!isZero(edge)) piece.edges.push_back(edge);
  }
  return piece;
}

/// Sets of vertices that triangles connect, by one vertex of each.
std::vector<int> partRepresentatives(const TriangleMesh& mesh);

template <typename Real>
void addMesh(const Member& member, bool solid, PlacedSet<Real>& set) {
  const TriangleMesh& mesh = member.shape.mesh;
  std::vector<Vec<Real>> points;
  for (const Vector3d& v : mesh.vertices) points.push_back(placed(member.pose, toVec<Real>(v)));
  Enclosure<Real> enclosure;
  for (const fcl::Triangle& t : mesh.triangles) {
    enclosure.triangles.push_back({points[t[0]], points[t[1]], points[t[2]]});
    set.pieces.push_back(trianglePiece(enclosure.triangles.back()));
  }
  if (solid) set.enclosures.push_back(std::move(enclosure));
  for (int vertex : partRepresentatives(mesh)) {
    set.part_points.push_back(points[static_cast<std::size_t>(vertex)]);
  }
}

template <typename Real>
void addOctree(const Member& member, PlacedSet<Real>& set) {
  const Real side(member.shape.resolution);
  for (const Voxel& voxel : member.shape.voxels) {
    if (!voxel.occupied) continue;
    const Vec<Real> lo{side * voxel.index[0], side * voxel.index[1], side * voxel.index[2]};
    set.pieces.push_back(boxPiece<Real>(lo, lo + Vec<Real>{side, side, side}, member.pose));
    set.part_points.push_back(set.pieces.back().points.front());
  }
}

template <typename Real>
void addConvex(const Member& member, PlacedSet<Real>& set) {
  const TriangleMesh& mesh = member.shape.mesh;
  Piece<Real> piece;
  for (const Vector3d& v : mesh.vertices)
    piece.points.push_back(placed(member.pose, toVec<Real>(v)));
  for (const fcl::Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      // Every edge is walked both ways.
      if (t[k] > t[(k + 1) % 3]) continue;
      piece.edges.push_back(piece.points[t[(k + 1) % 3]] - piece.points[t[k]]);
    }
  }
  set.pieces.push_back(std::move(piece));
  set.part_points.push_back(set.pieces.back().points.front());
}

/// False if the shape is none of flat pieces or a ball.
template <typename Real>
bool addMember(const Member& member, bool solid, PlacedSet<Real>& set) {
  const Shape& shape = member.shape;
  if (!shape.isOccupied()) return true;
  const Vec<Real> half = toVec<Real>(shape.sizes) * Real(0.5);
  switch (shape.kind) {
    case Kind::box:
      set.pieces.push_back(boxPiece<Real>(Vec<Real>{} - half, half, member.pose));
      break;
    case Kind::sphere:
      set.pieces.push_back({{placed(member.pose, Vec<Real>{})}, {}, Real(shape.sizes[0])});
      break;
    case Kind::triangle:
      set.pieces.push_back(
          trianglePiece<Real>({placed(member.pose, toVec<Real>(shape.mesh.vertices[0])),
                               placed(member.pose, toVec<Real>(shape.mesh.vertices[1])),
                               placed(member.pose, toVec<Real>(shape.mesh.vertices[2]))}));
      break;
    case Kind::convex:
      addConvex(member, set);
      return true;
    case Kind::mesh:
      addMesh(member, solid, set);
      return true;
    case Kind::octree:
      addOctree(member, set);
      return true;
    default:
      return false;
  }
  set.part_points.push_back(set.pieces.back().points.front());
  return true;
}

template <typename Real>
std::optional<PlacedSet<Real>> placedSet(const std::vector<Member>& members, bool solid) {
  PlacedSet<Real> set;
  for (const Member& member : members) {
    if (!addMember(member, solid, set)) return std::nullopt;
  }
  return set;
}

template <typename Real>
bool isWithin(const PlacedSet<Real>& inner, const PlacedSet<Real>& outer, const Vec<Real>& shift,
              const Real& least_sine) {
  for (const Enclosure<Real>& enclosure : outer.enclosures) {
    for (const Vec<Real>& point : inner.part_points) {
      const std::optional<int> winding = windingAround(enclosure, point + shift, least_sine);
      if (winding && *winding != 0) return true;
    }
  }
  return false;
}

/// Where A, displaced along the line, touches B; spans do not overlap and are in order. Nothing if
/// a ball meets something that is no ball.
template <typename Real>
std::optional<std::vector<Span<Real>>> contactAlong(const PlacedSet<Real>& a,
                                                    const PlacedSet<Real>& b,
                                                    const Line<Real>& line,
                                                    const Real& least_sine) {
  std::vector<Span<Real>> spans;
  for (const Piece<Real>& p : a.pieces) {
    for (const Piece<Real>& q : b.pieces) {
      if ((p.radius > 0) != (q.radius > 0)) return std::nullopt;
      if (const auto span = piecesTouch(p, q, line)) spans.push_back(*span);
    }
  }
  spans = united(std::move(spans));
  if (a.enclosures.empty() && b.enclosures.empty()) return spans;
  // Between contacts of the surfaces containment does not change.
  std::vector<Span<Real>> gaps;
  Real from = -line.reach;
  for (const Span<Real>& span : spans) {
    if (from < span.lo) gaps.push_back({from, span.lo});
    from = span.hi;
  }
  if (spans.empty() || from < line.reach) gaps.push_back({from, line.reach});
  for (const Span<Real>& gap : gaps) {
    const Real middle = (gap.lo + gap.hi) / 2;
    const Vec<Real> shift = line.start + line.direction * middle;
    if (isWithin(a, b, shift, least_sine) || isWithin(b, a, Vec<Real>{} - shift, least_sine)) {
      spans.push_back(gap);
    }
  }
  return united(std::move(spans));
}

}  // namespace fcl_prob_audit
