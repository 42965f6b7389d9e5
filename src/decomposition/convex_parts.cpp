// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "decomposition/cover_proof.h"
#include "decomposition/hull_volume.h"
#include "decomposition/piece_cutting.h"
#include "decomposition/point_sets.h"
#include "decomposition/solid_cover_proof.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace {

/// Where the largest coordinate is between 1/2 and 1: by how much parts are moved outwards that
/// have no more faces than this. The proofs cut along faces, one by one.
constexpr double kPadding = 3.2e-11;
constexpr std::size_t kFacesOfPadding = 400;

/// How much of the padding the proofs of the cover may use up.
detail::CoverMargins marginsOf(double padding) { return {0.4 * padding, 0.5 * padding}; }

void validateDecompositionRequest(const DecompositionRequest& request) {
  if (request.max_parts == 0) throw InvalidRequest("max_parts is 0, must be at least 1");
  if (request.pieces < request.max_parts) {
    throw InvalidRequest("pieces is " + std::to_string(request.pieces) +
                         ", must be at least max_parts, which is " +
                         std::to_string(request.max_parts));
  }
  if (!(request.concavity >= 0.0)) {
    throw InvalidRequest("concavity is " + detail::numberText(request.concavity) +
                         ", must be at least 0");
  }
}

/// Scaling by more would be seen.
constexpr double kMostScaling = 1e-6;

/// Of the padding, against the rounding of the hull and of the scaling.
constexpr double kReserve = 2.0;

double inradiusAbout(const Eigen::Vector3d& middle, const ConvexPolytope& hull) {
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexPolytope::Face& face : hull.faces) {
    least = std::min(least, face.offset - face.normal.dot(middle));
  }
  return hull.faces.empty() ? 0.0 : least;
}

void setOffsets(ConvexPolytope& hull) {
  for (ConvexPolytope::Face& face : hull.faces) {
    face.offset = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& v : hull.vertices) {
      face.offset = std::max(face.offset, face.normal.dot(v));
    }
  }
}

/// An octahedron contains a ball of its size over the square root of three.
ConvexPolytope hullOfOctahedra(const std::vector<Eigen::Vector3d>& points, double size) {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector3d& point : points) {
    for (int k = 0; k < 3; ++k) {
      for (const double sign : {-1.0, 1.0}) {
        corners.push_back(point + sign * size * Eigen::Vector3d::Unit(k));
      }
    }
  }
  return convexHull(corners);
}

/// A polytope with faces that contains every point within `padding` (metres) of a hull, and hardly
/// more: the hull scaled about its middle, or, where it is too thin for that, the hull of an
/// octahedron around each of its corners. So rounding cannot make it smaller than the hull.
ConvexPolytope paddedHull(ConvexPolytope hull, double padding) {
  const Eigen::Vector3d middle = detail::middleOf(hull.vertices);
  const double inradius = inradiusAbout(middle, hull);
  if (inradius * kMostScaling > kReserve * padding) {
    const double scale = 1.0 + kReserve * padding / inradius;
    for (Eigen::Vector3d& v : hull.vertices) v = middle + scale * (v - middle);
    setOffsets(hull);
    return hull;
  }
  ConvexPolytope thick = hullOfOctahedra(hull.vertices, kReserve * std::sqrt(3.0) * padding);
  if (thick.faces.empty()) throw InvalidGeometry("a part of a mesh has a hull without faces");
  return thick;
}

/// Below two to this power (1e-290 m) what parts are moved outwards by is lost where doubles end.
constexpr int kLeastExponent = -963;

/// All coordinates are below two to this power. \throws InvalidGeometry if that is too small
int exponentOfSize(const std::vector<Eigen::Vector3d>& points) {
  double largest = 0.0;
  for (const Eigen::Vector3d& v : points) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (largest > 0.0 && exponent < kLeastExponent) {
    throw InvalidGeometry("mesh to decompose: its largest coordinate is " +
                          detail::numberText(largest) + " m, too small for parts that cover it");
  }
  return exponent;
}

/// By a power of two, which rounds nothing that matters (subnormal numbers are below the padding).
void scale(std::vector<Eigen::Vector3d>& points, int exponent) {
  for (Eigen::Vector3d& v : points) {
    v = v.unaryExpr([exponent](double x) { return std::ldexp(x, exponent); });
  }
}

TriangleMesh scaled(TriangleMesh mesh, int exponent) {
  scale(mesh.vertices, exponent);
  return mesh;
}

void scale(ConvexPolytope& polytope, int exponent) {
  scale(polytope.vertices, exponent);
  for (ConvexPolytope::Face& face : polytope.faces) {
    face.offset = std::ldexp(face.offset, exponent);
  }
}

std::vector<detail::PointSet> pointsOfParts(const TriangleMesh& mesh,
                                            const DecompositionRequest& request) {
  std::vector<detail::PointSet> pieces = detail::cutIntoPieces(mesh, request.pieces);
  const detail::PointSet all(mesh.vertices.begin(), mesh.vertices.end());
  detail::unitePieces(request.max_parts, request.concavity * detail::hullVolume(all), pieces);
  if (pieces.size() == 1) return {all};
  return pieces;
}

struct Cover {
  std::vector<ConvexPolytope> polytopes;
  detail::CoverMargins margins;
};

/// Moved outwards, the further the more faces one of them has.
Cover paddedParts(const std::vector<detail::PointSet>& parts) {
  std::vector<ConvexPolytope> hulls;
  std::size_t faces = kFacesOfPadding;
  for (const detail::PointSet& points : parts) {
    hulls.push_back(convexHull(points));
    faces = std::max(faces, hulls.back().faces.size());
  }
  const double padding =
      kPadding * static_cast<double>(faces) / static_cast<double>(kFacesOfPadding);
  Cover cover{{}, marginsOf(padding)};
  for (ConvexPolytope& hull : hulls) {
    cover.polytopes.push_back(paddedHull(std::move(hull), padding));
  }
  return cover;
}

/// Of a mesh with coordinates of at most 1. \throws InvalidGeometry if the cover is not proven.
Cover coverOf(const TriangleMesh& mesh, const std::vector<detail::PointSet>& parts) {
  Cover cover = paddedParts(parts);
  if (const auto triangle = detail::firstUncovered(mesh, cover.polytopes, cover.margins)) {
    throw InvalidGeometry("mesh to decompose: triangle " + std::to_string(*triangle) +
                          " could not be proven to be within the parts");
  }
  return cover;
}

/// Of a mesh whose surface is covered.
bool coversSolidOf(const TriangleMesh& mesh, const Cover& cover) {
  const detail::MeshView view = detail::viewOf(mesh);
  if (detail::opennessOf(view)) return false;
  return detail::solidIsCovered(mesh, detail::ClosedMesh(view, "mesh to decompose"),
                                cover.polytopes, cover.margins);
}

}  // namespace

struct ConvexParts::Data {
  std::vector<ConvexPolytope> polytopes;
  std::vector<ConvexBody> bodies;
  std::vector<double> volumes;
  std::vector<std::shared_ptr<const fcl::Convexd>> geometries;
  std::vector<std::pair<std::size_t, std::size_t>> unions;
  bool covers_solid = false;
};

ConvexParts::ConvexParts(const TriangleMesh& mesh, const DecompositionRequest& request) {
  validateMesh(mesh, "mesh to decompose");
  validateDecompositionRequest(request);
  const int exponent = exponentOfSize(mesh.vertices);
  const TriangleMesh unit_mesh = scaled(mesh, -exponent);
  fill(unit_mesh, pointsOfParts(welded(unit_mesh), request), exponent);
}

ConvexParts::ConvexParts(const TriangleMesh& mesh, const std::vector<detail::PointSet>& parts) {
  validateMesh(mesh, "mesh to decompose");
  if (parts.empty()) throw InvalidRequest("a mesh needs a part at least");
  detail::PointSet all(mesh.vertices.begin(), mesh.vertices.end());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto is_finite = [](const Eigen::Vector3d& point) { return point.allFinite(); };
    if (parts[i].empty() || !std::all_of(parts[i].begin(), parts[i].end(), is_finite)) {
      throw InvalidGeometry("part " + std::to_string(i) +
                            " of a mesh has no points, or one that is not finite");
    }
    all.insert(all.end(), parts[i].begin(), parts[i].end());
  }
  const int exponent = exponentOfSize(all);
  std::vector<detail::PointSet> unit_parts = parts;
  for (detail::PointSet& points : unit_parts) scale(points, -exponent);
  fill(scaled(mesh, -exponent), unit_parts, exponent);
}

void ConvexParts::fill(const TriangleMesh& unit_mesh, const std::vector<detail::PointSet>& parts,
                       int exponent) {
  auto data = std::make_shared<Data>();
  Cover cover = coverOf(unit_mesh, parts);
  data->covers_solid = coversSolidOf(unit_mesh, cover);
  data->polytopes = std::move(cover.polytopes);
  std::vector<detail::PointSet> corners;
  for (ConvexPolytope& polytope : data->polytopes) {
    corners.push_back(polytope.vertices);
    data->volumes.push_back(std::ldexp(detail::hullVolume(corners.back()), 3 * exponent));
    scale(polytope, exponent);
    data->bodies.emplace_back(polytope.vertices);
    data->geometries.push_back(convexGeometry(polytope));
  }
  data->unions = detail::unionOrder(std::move(corners));
  data_ = std::move(data);
}

std::size_t ConvexParts::size() const { return data_->polytopes.size(); }

bool ConvexParts::coversSolid() const { return data_->covers_solid; }

const ConvexPolytope& ConvexParts::polytope(std::size_t part) const {
  return data_->polytopes.at(part);
}

const ConvexBody& ConvexParts::body(std::size_t part) const { return data_->bodies.at(part); }

double ConvexParts::volume(std::size_t part) const { return data_->volumes.at(part); }

std::shared_ptr<const fcl::Convexd> ConvexParts::geometry(std::size_t part) const {
  return data_->geometries.at(part);
}

const std::vector<std::pair<std::size_t, std::size_t>>& ConvexParts::unions() const {
  return data_->unions;
}

std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> ConvexParts::geometries() const {
  return {data_->geometries.begin(), data_->geometries.end()};
}

}  // namespace fcl_prob
