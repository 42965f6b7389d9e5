// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How often displaced meshes touch, by counting.
#pragma once

#include <fcl/narrowphase/collision.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "fcl_prob/whitening.h"
#include "partition_query.h"
#include "random_bodies.h"

namespace fcl_prob_test {

/// The solid angle of a closed surface seen from a point, in turns: 1 inside, 0 outside.
inline double windingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double angle = 0.0;
  for (const fcl::Triangle& t : mesh.triangles) {
    const Eigen::Vector3d a = (mesh.vertices[t[0]] - point).normalized();
    const Eigen::Vector3d b = (mesh.vertices[t[1]] - point).normalized();
    const Eigen::Vector3d c = (mesh.vertices[t[2]] - point).normalized();
    angle += 2 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return angle / (4 * fcl::constantsd::pi());
}

/// Displaced collisions by FCL; of solids also whether a vertex of either is in the other.
inline double sampledContact(const PartitionQuery& query, const TriangleMesh& a,
                             const TriangleMesh& b,
                             const fcl_prob::GaussianDisplacement& displacement, bool solid,
                             int samples, RandomBodies& random) {
  const fcl_prob::Whitening whitening(displacement);
  const auto holds = [](const TriangleMesh& mesh, const Eigen::Vector3d& point) {
    return std::fabs(windingNumber(mesh, point)) > 0.5;
  };
  int hits = 0;
  for (int i = 0; i < samples; ++i) {
    fcl::Transform3d pose = query.pose_a;
    pose.pretranslate(whitening.unapply(random.normalVector()));
    fcl::CollisionResultd result;
    fcl::collide(query.model_a.get(), pose, query.model_b.get(), query.pose_b, {}, result);
    bool hit = result.isCollision();
    if (solid && !hit) {
      hit = holds(b, query.pose_b.inverse() * (pose * a.vertices[0])) ||
            holds(a, pose.inverse() * (query.pose_b * b.vertices[0]));
    }
    hits += hit;
  }
  return static_cast<double>(hits) / samples;
}

/// A share of so many samples is where an interval says, within five standard errors.
inline void checkHoldsSampled(const fcl_prob::ProbabilityResult& result, double p, int samples) {
  const double middle = result.probability();
  const double error = 5 * std::sqrt(std::max(middle * (1 - middle), 10.0 / samples) / samples);
  INFO(*result.lower << " .. " << *result.upper << " sampled " << p);
  CHECK(p >= *result.lower - error);
  CHECK(p <= *result.upper + error);
}

/// Two meshes that are placed at random, and what is asked of them.
struct RandomScene {
  const TriangleMesh &body, &other;
  bool swapped, solid;
  double nearest, farthest;                   ///< of where they are placed
  double least_deviation, largest_deviation;  ///< of the displacement
  double tolerance;
};

/// The interval of a scene, held against as many samples. \param draws  what they are from
inline fcl_prob::ProbabilityResult checkedInterval(const RandomScene& scene, RandomBodies& random,
                                                   int samples, RandomBodies& draws) {
  const TriangleMesh& a = scene.swapped ? scene.other : scene.body;
  const TriangleMesh& b = scene.swapped ? scene.body : scene.other;
  PartitionQuery query(a, b);
  if (scene.solid) query.makeSolid();
  query.placeAtRandom(scene.nearest, scene.farthest, random);
  const auto displacement =
      obliqueDisplacement(scene.least_deviation, scene.largest_deviation, random);
  const fcl_prob::ProbabilityResult result =
      query.run(displacement, intervalRequest(scene.tolerance));
  const double p = sampledContact(query, a, b, displacement, scene.solid, samples, draws);
  INFO("body " << (scene.swapped ? "second" : "first") << (scene.solid ? ", solid" : ""));
  for (const std::string& line : result.plan) UNSCOPED_INFO(line);
  checkHoldsSampled(result, p, samples);
  return result;
}

}  // namespace fcl_prob_test
