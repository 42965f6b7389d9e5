// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Who said no is not asked again in that call, whatever it is made of.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <functional>
#include <map>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "poses.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace cancelling {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
using Progress = std::function<bool(const ProbabilityProgress&)>;

fcl::Transform3d turnedAt(double x, double y, double z) {
  fcl::Transform3d pose = at(x, y, z);
  pose.linear() = Eigen::Quaterniond(0.8, 0.3, -0.2, 0.4).normalized().toRotationMatrix();
  return pose;
}

GaussianDisplacement displacement() {
  return GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08},
                                                      Eigen::Quaterniond(1, 0.2, 0.1, -0.3));
}

std::map<std::string, Geometry> shapes() {
  return {{"box", std::make_shared<fcl::Boxd>(0.3, 0.4, 0.5)},
          {"ball", std::make_shared<fcl::Sphered>(0.3)},
          {"rod", std::make_shared<fcl::Capsuled>(0.2, 0.5)},
          {"cone", std::make_shared<fcl::Coned>(0.4, 0.6)},
          {"egg", std::make_shared<fcl::Ellipsoidd>(0.2, 0.3, 0.4)},
          {"box mesh", makeModel<fcl::OBBRSSd>(boxMesh({0.3, 0.4, 0.5}))},
          {"mesh", makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 5, 7, 1))},
          {"torus", makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 10, 6))}};
}

/// Calls `ask` with an on_progress that says no at its call of this number.
/// \return  calls after that
int callsAfterNo(int last, const std::function<void(const Progress&)>& ask) {
  int calls = 0, after = 0;
  ask([&](const ProbabilityProgress&) {
    after += calls >= last;
    return ++calls < last;
  });
  return after;
}

TEST_CASE("no method asks again about any pair", "[query]") {
  const GaussianMixture mixture(
      {{0.7, displacement()}, {0.3, displacement().withMean({-0.1, 0.1, 0.05})}});
  const TruncatedGaussian truncated(displacement(), 2.0);
  for (const auto& [name_a, a] : shapes()) {
    for (const auto& [name_b, b] : shapes()) {
      const PreparedQuery query(a, b);
      for (const auto method :
           {ProbabilityMethod::automatic, ProbabilityMethod::interval, ProbabilityMethod::estimate,
            ProbabilityMethod::general_pcd, ProbabilityMethod::rare_event}) {
        for (const int last : {1, 2, 5}) {
          for (const bool decides : {false, true}) {
            ProbabilityRequest request;
            request.method = method;
            // Too few for what is asked: other methods are tried.
            request.max_cells = 300;
            request.relative_tolerance = 1e-10;
            request.absolute_tolerance = 0.0;
            request.gradient = last == 2 && !decides;
            request.samples = 2'000;
            if (decides) request.threshold = 0.1;
            CAPTURE(name_a, name_b, toString(method), last, decides);
            const auto ask = [&](const Progress& progress) {
              request.on_progress = progress;
              ProbabilityResult result;
              try {
                query.collisionProbability(turnedAt(0.6, 0.1, 0.1), kIdentity, displacement(),
                                           request, result);
              } catch (const UnsupportedGeometry&) {
              }
            };
            CHECK(callsAfterNo(last, ask) == 0);
          }
        }
      }
      for (const int last : {1, 3}) {
        ProbabilityRequest request;
        request.relative_tolerance = 1e-8;
        request.max_cells = 300;
        ProbabilityResult result;
        CAPTURE(name_a, name_b, last);
        CHECK(callsAfterNo(last, [&](const Progress& progress) {
                request.on_progress = progress;
                collisionProbability(query, turnedAt(0.6, 0.1, 0.1), kIdentity, mixture, request,
                                     result);
              }) == 0);
        CHECK(callsAfterNo(last, [&](const Progress& progress) {
                request.on_progress = progress;
                collisionProbability(query, turnedAt(0.6, 0.1, 0.1), kIdentity, truncated, request,
                                     result);
              }) == 0);
      }
    }
  }
}

TEST_CASE("neither do groups, managers, gradients and sampling", "[query]") {
  const auto all = shapes();
  const GroupQuery::Geometries a{all.at("mesh"), all.at("box")}, b{all.at("torus")};
  const GroupQuery group(a, b);
  const std::vector<fcl::Transform3d> poses_a{turnedAt(0.9, 0.1, 0.1), turnedAt(-0.8, 0.1, 0.0)};
  fcl::DynamicAABBTreeCollisionManagerd manager;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  for (const double x : {-0.9, 0.0, 0.95}) {
    objects.push_back(
        std::make_unique<fcl::CollisionObjectd>(all.at("mesh"), turnedAt(x, 0.1, 0.1)));
    manager.registerObject(objects.back().get());
  }
  manager.setup();
  const fcl::CollisionObjectd object(all.at("torus"), kIdentity);
  for (const unsigned threads : {1u, 2u}) {
    for (const int last : {1, 2, 3, 7}) {
      CAPTURE(threads, last);
      ProbabilityRequest request;
      request.threads = threads;
      request.relative_tolerance = 1e-7;
      request.max_cells = 5'000;
      request.samples = 40'000;
      CHECK(callsAfterNo(last, [&](const Progress& progress) {
              request.on_progress = progress;
              ProbabilityResult result;
              group.collisionProbability(poses_a, {kIdentity}, displacement(), request, result);
            }) == 0);
      CHECK(callsAfterNo(last, [&](const Progress& progress) {
              BroadphaseRequest of_manager;
              of_manager.query = request;
              of_manager.query.on_progress = progress;
              of_manager.displacement = [&](const fcl::CollisionObjectd& moved) {
                return &moved == &object ? displacement() : GaussianDisplacement();
              };
              BroadphaseResult result;
              collisionProbability(&object, &manager, of_manager, result);
            }) == 0);
      CHECK(callsAfterNo(last, [&](const Progress& progress) {
              MotionGradientRequest lines;
              lines.threads = threads;
              lines.on_progress = progress;
              group.motionGradient(poses_a, {kIdentity}, displacement(), rigidMotions(2), lines);
            }) == 0);
      CHECK(callsAfterNo(last, [&](const Progress& progress) {
              request.on_progress = progress;
              monteCarloProbability(*all.at("mesh"), poses_a[0], *all.at("torus"), kIdentity,
                                    displacement(), request);
            }) == 0);
      CHECK(callsAfterNo(last, [&](const Progress& progress) {
              request.on_progress = progress;
              rareEventProbability(*all.at("mesh"), poses_a[0], *all.at("torus"), kIdentity,
                                   displacement(), request);
            }) == 0);
    }
  }
}

}  // namespace cancelling
