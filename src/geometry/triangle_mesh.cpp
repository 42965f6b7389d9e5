// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/triangle_mesh.h"

#include <boost/container_hash/hash.hpp>
#include <limits>
#include <unordered_map>

namespace fcl_prob {
namespace {

struct HashOfVertex {
  std::size_t operator()(const fcl::Vector3d& v) const {
    return boost::hash_range(v.data(), v.data() + 3);
  }
};

/// -0.0 equals 0.0 but does not hash like it.
fcl::Vector3d withoutNegativeZeros(const fcl::Vector3d& v) { return v + fcl::Vector3d::Zero(); }

}  // namespace

void validateMesh(const TriangleMesh& mesh, const std::string& name) {
  constexpr std::size_t kMaxCount = std::numeric_limits<int>::max();
  if (mesh.triangles.empty()) throw InvalidGeometry(name + ": no triangles");
  // FCL counts in int, and its tree has nearly twice as many nodes as triangles.
  if (mesh.triangles.size() > kMaxCount / 2 || mesh.vertices.size() > kMaxCount) {
    throw InvalidGeometry(name + ": " + std::to_string(mesh.triangles.size()) +
                          " triangles are more than FCL can count");
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) {
      throw InvalidGeometry(name + ": vertex " + std::to_string(i) +
                            " has a coordinate that is not finite");
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      if (mesh.triangles[i][corner] >= mesh.vertices.size()) {
        throw InvalidGeometry(name + ": triangle " + std::to_string(i) + " has vertex index " +
                              std::to_string(mesh.triangles[i][corner]) + ", but there are only " +
                              std::to_string(mesh.vertices.size()) + " vertices");
      }
    }
  }
}

TriangleMesh normalized(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : mesh.vertices) box.extend(v);
  const double longest = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (!(longest > 0.0)) throw InvalidGeometry("mesh without extent cannot be normalized");
  const fcl::Vector3d centre = 0.5 * box.min() + 0.5 * box.max();
  TriangleMesh result = mesh;
  for (fcl::Vector3d& v : result.vertices) v = (v - centre) / longest;
  result.coordinate_error /= longest;
  return result;
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.coordinate_error = mesh.coordinate_error;
  result.notes = mesh.notes;
  result.triangles.reserve(mesh.triangles.size());
  std::unordered_map<fcl::Vector3d, std::size_t, HashOfVertex> known;
  known.reserve(mesh.vertices.size());
  const auto indexOf = [&](std::size_t old_index) {
    const fcl::Vector3d vertex = withoutNegativeZeros(mesh.vertices[old_index]);
    const auto [position, added] = known.emplace(vertex, result.vertices.size());
    if (added) result.vertices.push_back(vertex);
    return position->second;
  };
  for (const fcl::Triangle& triangle : mesh.triangles) {
    const std::size_t first = indexOf(triangle[0]);
    const std::size_t second = indexOf(triangle[1]);
    const std::size_t third = indexOf(triangle[2]);
    result.triangles.emplace_back(first, second, third);
  }
  return result;
}

}  // namespace fcl_prob
