// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/certificate_writer.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <ostream>
#include <string>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "geometry/convex_vertices.h"
#include "geometry/mesh_visitor.h"
#include "geometry/outer_mesh.h"

namespace fcl_prob::detail {
namespace {

// A whitening that is not turned is diag(1/σ) Aᵀ up to rounding, whatever the rounding of its rows
// means along axes of far larger deviations.
constexpr double kNotTurned = 1e-14;

/// Writes [x, y, …].
template <typename List, typename Write>
void writeList(std::ostream& out, const List& list, const Write& write) {
  const char* separator = "[";
  for (const auto& element : list) {
    out << separator;
    write(element);
    separator = ",";
  }
  out << (*separator == '[' ? "[]" : "]");
}

void writeVector(std::ostream& out, const Eigen::Vector3d& v) {
  out << '[' << numberText(v[0]) << ',' << numberText(v[1]) << ',' << numberText(v[2]) << ']';
}

void writeVectors(std::ostream& out, const std::vector<Eigen::Vector3d>& vectors) {
  writeList(out, vectors, [&](const Eigen::Vector3d& v) { writeVector(out, v); });
}

void writeTriangles(std::ostream& out, const std::vector<Eigen::Vector3i>& triangles) {
  writeList(out, triangles, [&](const Eigen::Vector3i& t) {
    out << '[' << t[0] << ',' << t[1] << ',' << t[2] << ']';
  });
}

// As a string of JSON.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '"';
}

std::vector<Eigen::Vector3d> rowsOf(const Eigen::Matrix3d& matrix, int count) {
  std::vector<Eigen::Vector3d> rows;
  for (int i = 0; i < count; ++i) rows.emplace_back(matrix.row(i).transpose());
  return rows;
}

bool isTurned(const Whitening& whitening, const GaussianDisplacement& displacement) {
  for (int k = 0; k < whitening.rank(); ++k) {
    const Eigen::Vector3d row =
        whitening.matrix().row(k).transpose() * displacement.standardDeviations()[k];
    if (!((row - displacement.axes().col(k)).norm() < kNotTurned)) return true;
  }
  return false;
}

bool isBox(const fcl::CollisionGeometryd& geometry) {
  return geometry.getNodeType() == fcl::GEOM_BOX;
}

/// The hull of some points, swept by a ball.
struct SweptHull {
  std::vector<Eigen::Vector3d> vertices;
  double radius = 0.0;
};

/// What a polytope, sphere or capsule is, metres, geometry's frame; nothing for others, and for
/// boxes, which are written with their triangles.
std::optional<SweptHull> sweptHullOf(const fcl::CollisionGeometryd& geometry) {
  if (isBox(geometry)) return std::nullopt;
  if (geometry.getNodeType() == fcl::GEOM_SPHERE) {
    const auto& sphere = static_cast<const fcl::Sphered&>(geometry);
    return SweptHull{{Eigen::Vector3d::Zero()}, sphere.radius};
  }
  if (geometry.getNodeType() == fcl::GEOM_CAPSULE) {
    const auto& capsule = static_cast<const fcl::Capsuled&>(geometry);
    const Eigen::Vector3d end(0.0, 0.0, 0.5 * capsule.lz);
    return SweptHull{{-end, end}, capsule.radius};
  }
  auto vertices = polytopeVertices(geometry);
  if (!vertices) return std::nullopt;
  return SweptHull{std::move(*vertices)};
}

// A box, or a cell of an octree, which is one about its middle; triangles with their normals
// outwards.
TriangleMesh boxOf(const PieceTree& tree, const PieceTree::Part& part, int body,
                   const fcl::CollisionGeometryd& geometry) {
  const OuterMeshRequest exactly{0.0, Eigen::Vector3d::Zero(), 0.0};
  if (isBox(geometry)) return outerMesh(geometry, exactly);
  const PieceTree::Body& cell = tree.bodies[static_cast<std::size_t>(body)];
  const auto& corners = tree.shapes[static_cast<std::size_t>(cell.shape)].body.points;
  TriangleMesh box = outerMesh(fcl::Boxd(2.0 * corners.front().cwiseAbs()), exactly);
  for (Eigen::Vector3d& vertex : box.vertices) vertex += cell.position + part.origin;
  return box;
}

std::vector<Eigen::Vector3i> trianglesOf(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3i> triangles;
  for (const fcl::Triangle& t : mesh.triangles) {
    triangles.emplace_back(static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]));
  }
  return triangles;
}

void requireCertifiable(const CertifiedObject& object) {
  for (std::size_t i = 0; i < object.geometries.size(); ++i) {
    const fcl::CollisionGeometryd& geometry = *object.geometries[i];
    const GeometryKind kind = kindOf(geometry);
    if (kind == GeometryKind::mesh || kind == GeometryKind::octree || isBox(geometry)) continue;
    if (sweptHullOf(geometry)) continue;
    throw UnsupportedGeometry("no certificate of member " + std::to_string(i) + " of " +
                              object.name + ": " + nodeTypeName(geometry.getNodeType()) +
                              " is no mesh, polytope, Sphere, Capsule or OcTree");
  }
}

// The first version had none of these, and no displacement that is certain.
bool hasSweptHulls(const CertifiedObject& object) {
  return std::any_of(object.geometries.begin(), object.geometries.end(),
                     [](const auto* geometry) { return sweptHullOf(*geometry).has_value(); });
}

}  // namespace

CertificateWriter::CertificateWriter(std::ostream& out, const CertifiedObject& a,
                                     const CertifiedObject& b, ContactMeaning contact)
    : out_(out), a_(a), b_(b), contact_(contact) {
  requireCertifiable(a);
  requireCertifiable(b);
  claim_observer = this;
}

void CertificateWriter::frame(const Whitening& whitening,
                              const GaussianDisplacement& displacement) {
  rank_ = whitening.rank();
  if (rank_ < displacement.rank()) {
    throw InvalidRequest("no certificate of a displacement of rank " +
                         std::to_string(displacement.rank()) + " of which the cells have " +
                         std::to_string(rank_) + " axes");
  }
  const int version = rank_ == 0 || hasSweptHulls(a_) || hasSweptHulls(b_) ? 2 : 1;
  out_ << R"({"fcl_prob_certificate":)" << version << R"(,"name":)"
       << quoted(a_.name + " and " + b_.name) << R"(,"contact":")"
       << (contact_ == ContactMeaning::solid ? "solid" : "surface") << R"(","mean":)";
  writeVector(out_, displacement.mean());
  out_ << R"(,"axes":)";
  writeVectors(out_, rowsOf(displacement.axes().transpose(), rank_));
  out_ << R"(,"deviations":)";
  const Eigen::VectorXd deviations = displacement.standardDeviations().head(rank_);
  writeList(out_, deviations, [&](double sd) { out_ << numberText(sd); });
  out_ << R"(,"whitening":)";
  if (isTurned(whitening, displacement)) {
    writeVectors(out_, rowsOf(whitening.matrix(), rank_));
  } else {
    out_ << "null";
  }
  out_ << "}\n";
  of_a_ = writeObject(a_, "A");
  of_b_ = writeObject(b_, "B");
  writeCaps(a_, "A", of_a_);
  writeCaps(b_, "B", of_b_);
}

CertificateWriter::Numbers CertificateWriter::writeObject(const CertifiedObject& object,
                                                          const char* name) {
  const PieceTree& tree = *object.placed.tree;
  Numbers numbers{std::vector<int>(tree.vertices.size(), -1),
                  std::vector<int>(tree.triangles.size() + tree.bodies.size(), -1)};
  for (std::size_t i = 0; i < object.geometries.size(); ++i) {
    const PieceTree::Part& part = tree.parts[i];
    const fcl::CollisionGeometryd& geometry = *object.geometries[i];
    if (kindOf(geometry) == GeometryKind::mesh) {
      writeMesh(tree, part, geometry, {name, object.placed.parts[i]}, numbers);
      continue;
    }
    for (int body = part.bodies.begin; body < part.bodies.end; ++body) {
      numbers.of_piece[tree.triangles.size() + static_cast<std::size_t>(body)] = numbers.pieces++;
      if (const auto hull = sweptHullOf(geometry)) {
        numbers.vertices += static_cast<int>(hull->vertices.size());
        writePart({name, object.placed.parts[i]}, hull->vertices, {}, true, hull->radius);
        continue;
      }
      const TriangleMesh box = boxOf(tree, part, body, geometry);
      numbers.vertices += static_cast<int>(box.vertices.size());
      writePart({name, object.placed.parts[i]}, box.vertices, trianglesOf(box), true);
    }
  }
  return numbers;
}

// In the order of the geometry's own vertices, and of the tree's triangles.
void CertificateWriter::writeMesh(const PieceTree& tree, const PieceTree::Part& part,
                                  const fcl::CollisionGeometryd& geometry, const NamedPart& named,
                                  Numbers& numbers) {
  const MeshView mesh = meshView(geometry);
  const std::vector<Eigen::Vector3d> vertices(mesh.vertices, mesh.vertices + mesh.vertex_count);
  std::vector<Eigen::Vector3i> triangles;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    numbers.of_vertex[static_cast<std::size_t>(PieceTree::vertexOf(part, v))] =
        numbers.vertices + static_cast<int>(v);
  }
  for (int t = part.triangles.begin; t < part.triangles.end; ++t) {
    Eigen::Vector3i corners = tree.triangles[static_cast<std::size_t>(t)];
    for (int& corner : corners) {
      corner = numbers.of_vertex[static_cast<std::size_t>(corner)] - numbers.vertices;
    }
    triangles.push_back(corners);
    numbers.of_piece[static_cast<std::size_t>(t)] = numbers.pieces++;
  }
  numbers.vertices += mesh.vertex_count;
  writePart(named, vertices, triangles, false);
}

void CertificateWriter::writePart(const NamedPart& named,
                                  const std::vector<Eigen::Vector3d>& vertices,
                                  const std::vector<Eigen::Vector3i>& triangles, bool convex,
                                  double radius) {
  out_ << R"({"part":")" << named.object << R"(","rotation":)";
  writeVectors(out_, rowsOf(named.placed.pose.linear(), 3));
  out_ << R"(,"translation":)";
  writeVector(out_, named.placed.pose.translation());
  out_ << R"(,"vertices":)";
  writeVectors(out_, vertices);
  out_ << R"(,"triangles":)";
  writeTriangles(out_, triangles);
  out_ << R"(,"convex":)" << (convex ? "true" : "false") << R"(,"solid":)"
       << (named.placed.solid ? "true" : "false");
  if (radius > 0.0) out_ << R"(,"radius":)" << numberText(radius);
  out_ << "}\n";
}

// Of a single mesh: the apexes are the vertices of its tree that are none of its own.
void CertificateWriter::writeCaps(const CertifiedObject& object, const char* name,
                                  Numbers& numbers) {
  const PieceTree& tree = *object.placed.tree;
  if (tree.parts.size() > 1 || !tree.caps || tree.caps->triangles.empty()) return;
  std::vector<Eigen::Vector3d> apexes;
  int next = static_cast<int>(meshView(*object.geometries[0]).vertex_count);
  std::vector<Eigen::Vector3i> triangles;
  for (const Eigen::Vector3i& corners : tree.caps->triangles) {
    Eigen::Vector3i numbered;
    for (int k = 0; k < 3; ++k) {
      int& number = numbers.of_vertex[static_cast<std::size_t>(corners[k])];
      if (number < 0) {
        number = next++;
        apexes.push_back(tree.parts[0].origin +
                         tree.vertices[static_cast<std::size_t>(corners[k])]);
      }
      numbered[k] = number;
    }
    triangles.push_back(numbered);
  }
  out_ << R"({"caps":")" << name << R"(","part":0,"vertices":)";
  writeVectors(out_, apexes);
  out_ << R"(,"triangles":)";
  writeTriangles(out_, triangles);
  out_ << "}\n";
}

CertificateWriter::Corners CertificateWriter::cornersOf(const Cell& cell) const {
  Corners corners{};
  for (int k = 0; k < rank_; ++k) {
    corners[static_cast<std::size_t>(k)] = cell.lo[k];
    corners[static_cast<std::size_t>(rank_ + k)] = cell.hi[k];
  }
  return corners;
}

void CertificateWriter::claim(const Claim& claim) {
  const auto* const planes = claim.within.planes.data();
  const bool bounds_nothing =
      std::any_of(planes, planes + claim.within.count,
                  [&](const auto& plane) { return plane.m.head(rank_).isZero(0.0); });
  if (bounds_nothing) return;  // all of the cell or nothing, by a level that rounding decides
  const Corners corners = cornersOf(claim.cell);
  if (claim.within.count == 0) {
    CellClaims whole;
    (claim.collides ? whole.contact : whole.free).push_back(claim);
    return writeCell(corners, whole);
  }
  CellClaims& claims = open_[corners];
  (claim.collides ? claims.contact : claims.free).push_back(claim);
}

void CertificateWriter::divided(const Cell& cell) { open_.erase(cornersOf(cell)); }

void CertificateWriter::writeCell(const Corners& corners, const CellClaims& claims) {
  ++cells_;
  const std::size_t count = 2 * static_cast<std::size_t>(rank_);
  out_ << R"({"cell":[)";
  for (std::size_t k = 0; k < count; ++k) out_ << (k > 0 ? "," : "") << numberText(corners[k]);
  out_ << ']';
  if (!claims.free.empty()) {
    out_ << R"(,"free":)";
    if (claims.free[0].within.count == 0) {
      out_ << "true";
    } else {
      writeList(out_, claims.free,
                [&](const Claim& claim) { writePlane(claim.within.planes[0], -1.0); });
    }
  }
  if (!claims.contact.empty()) {
    out_ << R"(,"contact":)";
    writeList(out_, claims.contact, [&](const Claim& claim) {
      out_ << R"({"planes":)";
      const auto* const first = claim.within.planes.data();
      const std::vector<CellPlane> planes(first, first + claim.within.count);
      writeList(out_, planes, [&](const CellPlane& plane) { writePlane(plane, 1.0); });
      out_ << R"(,"by":)";
      writeWitness(claim);
      out_ << '}';
    });
  }
  out_ << "}\n";
}

void CertificateWriter::writePlane(const CellPlane& plane, double sign) {
  out_ << '[';
  for (int k = 0; k < rank_; ++k) out_ << numberText(sign * plane.m[k]) << ',';
  out_ << numberText(sign * plane.s) << ']';
}

void CertificateWriter::writeWitness(const Claim& claim) {
  if (claim.pair) {
    const int piece_a = a_.placed.tree->nodes[claim.pair->a].piece;
    const int piece_b = b_.placed.tree->nodes[claim.pair->b].piece;
    out_ << R"({"pair":[)" << of_a_.of_piece[piece_a] << ',' << of_b_.of_piece[piece_b] << "]}";
  } else if (claim.crossing) {
    const CrossingProof& proof = *claim.crossing;
    const std::vector<int>& numbers = (proof.of_a ? of_a_ : of_b_).of_vertex;
    out_ << R"({"inside":")" << (proof.of_a ? 'A' : 'B') << R"(","vertex":)"
         << numbers[proof.inside];
    if (proof.outside >= 0) out_ << R"(,"outside":)" << numbers[proof.outside];
    out_ << '}';
  } else {
    out_ << R"({"contained":true})";
  }
}

void CertificateWriter::finish(const Bounds& bounds) {
  for (const auto& [corners, claims] : open_) writeCell(corners, claims);
  out_ << R"({"lower":)" << numberText(bounds.lower) << R"(,"upper":)" << numberText(bounds.upper)
       << R"(,"cells":)" << cells_ << "}\n";
}

}  // namespace fcl_prob::detail
