// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/touch_map.h"

#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <set>

#include "cli/random_displacement.h"

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kMostContacts = 100'000;

double areaOf(const TriangleMesh& mesh, const fcl::Triangle& t) {
  const Eigen::Vector3d side = mesh.vertices[t[1]] - mesh.vertices[t[0]];
  return 0.5 * side.cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm();
}

/// Weights of triangles as densities at their vertices, the largest of which becomes 1.
std::vector<double> vertexDensities(const TriangleMesh& mesh, const std::vector<double>& weights) {
  std::vector<double> density(mesh.vertices.size(), 0.0);
  std::vector<double> area(mesh.vertices.size(), 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      density[mesh.triangles[i][k]] += weights[i];
      area[mesh.triangles[i][k]] += areaOf(mesh, mesh.triangles[i]);
    }
  }
  double largest = 0.0;
  for (std::size_t v = 0; v < density.size(); ++v) {
    density[v] = area[v] > 0.0 ? density[v] / area[v] : 0.0;
    largest = std::max(largest, density[v]);
  }
  if (largest > 0.0) {
    for (double& value : density) value /= largest;
  }
  return density;
}

}  // namespace

TouchMap touchMap(const TriangleMesh& a, const TriangleMesh& b,
                  const GaussianDisplacement& displacement, std::size_t samples,
                  std::uint64_t seed) {
  const auto model_a = buildModel<fcl::OBBRSSd>(a);
  const auto model_b = buildModel<fcl::OBBRSSd>(b);
  const Whitening whitening(displacement);
  const fcl::CollisionRequestd request(kMostContacts);
  std::vector<double> weights(a.triangles.size(), 0.0);
  TouchMap map;
  map.samples = samples;
  for (std::size_t i = 0; i < samples; ++i) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = randomDisplacement(whitening, seed, i);
    fcl::CollisionResultd result;
    fcl::collide(model_a.get(), pose, model_b.get(), fcl::Transform3d::Identity(), request, result);
    std::set<fcl::intptr_t> touched;
    for (std::size_t c = 0; c < result.numContacts(); ++c) touched.insert(result.getContact(c).b1);
    for (const fcl::intptr_t triangle : touched)
      weights[triangle] += 1.0 / static_cast<double>(touched.size());
    if (!touched.empty()) ++map.hits;
  }
  map.likelihood = vertexDensities(a, weights);
  return map;
}

}  // namespace fcl_prob::cli
