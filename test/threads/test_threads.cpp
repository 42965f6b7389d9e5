// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// All that may be called from several threads at once, in one small executable for ThreadSanitizer.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include <thread>

#include "catch.h"
#include "fcl_prob/batch.h"
#include "fcl_prob/group.h"
#include "fcl_prob/pose_probability.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#ifdef FCL_PROB_HAS_IO
#include "fcl_prob/mesh_io.h"
#include "temporary_folder.h"
#endif

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

constexpr int kThreads = 4;

/// Runs `work(i)` for i below kThreads, all at once.
template <typename Work>
void atOnce(const Work& work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) threads.emplace_back([&work, i] { work(i); });
  for (std::thread& thread : threads) thread.join();
}

fcl::Transform3d at(double x) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(x, 0.1, 0.2);
  return pose;
}

GaussianDisplacement displacement() {
  return GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08});
}

ProbabilityRequest requestOf(ProbabilityMethod method, unsigned threads) {
  ProbabilityRequest request;
  request.method = method;
  request.relative_tolerance = 0.1;
  request.samples = 400;
  request.threads = threads;
  return request;
}

PreparedQuery meshes() {
  return {makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 4, 6, 1)),
          makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5))};
}

PreparedQuery shapes() {
  return {std::make_shared<fcl::Cylinderd>(0.3, 0.5), std::make_shared<fcl::Boxd>(0.4, 0.5, 0.6)};
}

double answer(const PreparedQuery& query, ProbabilityMethod method, unsigned threads) {
  ProbabilityResult result;
  return query.collisionProbability(at(0.7), at(0.0), displacement(), requestOf(method, threads),
                                    result);
}

}  // namespace

// The first queries of an object prepare what others then share: the reference comes last.
TEST_CASE("threads share a prepared query", "[threads]") {
  for (const auto method :
       {ProbabilityMethod::interval, ProbabilityMethod::estimate, ProbabilityMethod::monte_carlo,
        ProbabilityMethod::rare_event, ProbabilityMethod::convex_pcd}) {
    for (const bool curved : {false, true}) {
      const PreparedQuery query = curved ? shapes() : meshes();
      std::vector<double> p(kThreads);
      atOnce([&](int i) { p[static_cast<std::size_t>(i)] = answer(query, method, 1); });
      for (const double each : p) CHECK(each == answer(query, method, 1));
    }
  }
}

TEST_CASE("threads share the preparation of an exact answer", "[threads]") {
  const PreparedQuery query = shapes();
  std::vector<double> p(kThreads);
  atOnce(
      [&](int i) { p[static_cast<std::size_t>(i)] = answer(query, ProbabilityMethod::exact, 1); });
  for (const double each : p) CHECK(each == answer(query, ProbabilityMethod::exact, 1));
}

TEST_CASE("samples and waypoints on two threads", "[threads]") {
  const PreparedQuery query = meshes();
  for (const auto method : {ProbabilityMethod::monte_carlo, ProbabilityMethod::rare_event}) {
    CHECK(answer(query, method, 2) == answer(query, method, 1));
  }
  BatchRequest request;
  request.query = requestOf(ProbabilityMethod::automatic, 2);
  int calls = 0;
  request.on_progress = [&](const BatchProgress&) { return ++calls > 0; };
  std::vector<Waypoint> waypoints;
  for (int i = 0; i < 12; ++i) waypoints.push_back({at(0.1 * i), at(0.0), displacement()});
  CHECK(collisionProbabilities(query, waypoints, request).done == 12);
  CHECK(calls == 12);
  CancellationToken token;
  request.cancellation = &token;
  std::thread canceller([&] { token.cancel(); });
  CHECK(collisionProbabilities(query, waypoints, request).done <= 12);
  canceller.join();
}

TEST_CASE("threads share a group", "[threads]") {
  const GroupQuery query({makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 4, 6, 1)),
                          std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4)},
                         {makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5))});
  std::vector<ProbabilityResult> results(kThreads);
  const auto ask = [&](ProbabilityResult& result) {
    query.collisionProbability({at(0.7), at(-0.8)}, {at(0.0)}, displacement(),
                               requestOf(ProbabilityMethod::interval, 1), result);
  };
  atOnce([&](int i) { ask(results[static_cast<std::size_t>(i)]); });
  ProbabilityResult reference;
  ask(reference);
  for (const ProbabilityResult& result : results) CHECK(result.upper == reference.upper);
}

// Enough cells for rounds of them; boxes, and polytopes beside a convex mesh.
TEST_CASE("cells and samples of one query on several threads", "[threads]") {
  const auto ring = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 12, 8));
  RandomBodies random(1);
  const auto hull = makeModel<fcl::OBBRSSd>(hullMesh(random.onSphere(30, 0.3)));
  const auto bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 8, 10, 1));
  const auto box = std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4);
  for (const GroupQuery& query :
       {GroupQuery({bumpy}, {ring}), GroupQuery({hull}, {ring}), GroupQuery({box}, {ring})}) {
    for (const auto method : {ProbabilityMethod::interval, ProbabilityMethod::estimate}) {
      for (const auto contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
        ProbabilityRequest request = requestOf(method, 1);
        request.relative_tolerance = 0.01;
        request.contact = contact;
        request.on_progress = [](const ProbabilityProgress&) { return true; };
        ProbabilityResult alone, together;
        query.collisionProbability({at(0.7)}, {at(0.0)}, displacement(), request, alone);
        request.threads = kThreads;
        query.collisionProbability({at(0.7)}, {at(0.0)}, displacement(), request, together);
        CHECK(together.upper == alone.upper);
        CHECK(together.estimate == alone.estimate);
        CHECK(together.statistics.pairs_tested == alone.statistics.pairs_tested);
      }
    }
  }
}

TEST_CASE("lines and evenly spread samples on two threads", "[threads]") {
  const auto body = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 4, 6, 1));
  const auto ring = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5));
  const GroupQuery group({body, std::make_shared<fcl::Sphered>(0.2)}, {ring});
  MotionGradientRequest lines;
  lines.lines = 600;
  const auto gradient = [&] {
    return group.motionGradient({at(0.7), at(-0.8)}, {at(0.0)}, displacement(), rigidMotions(2),
                                lines);
  };
  const MotionGradient alone = gradient();
  lines.threads = 2;
  lines.on_progress = [](const ProbabilityProgress&) { return true; };
  CHECK(gradient().gradient == alone.gradient);
  const PreparedPoseQuery pose(body, ring);
  const auto error = PoseError::fromIndependent(displacement(), 0.3 * Eigen::Matrix3d::Identity());
  const auto estimate = [&](unsigned threads) {
    ProbabilityResult result;
    pose.collisionProbability(at(0.7), at(0.0), error,
                              requestOf(ProbabilityMethod::estimate, threads), result);
    return *result.estimate;
  };
  CHECK(estimate(2) == estimate(1));
}

#ifdef FCL_PROB_HAS_IO
TEST_CASE("threads load meshes at once", "[threads]") {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  std::vector<std::size_t> triangles(kThreads);
  atOnce([&](int i) { triangles[static_cast<std::size_t>(i)] = loadMesh(file).triangles.size(); });
  for (const std::size_t count : triangles) CHECK(count == 2);
}
#endif
