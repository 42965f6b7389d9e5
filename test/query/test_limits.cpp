// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A limit is one of the whole call, whatever that is made of; and no number in a request, however
// extreme, leads to an exception that is not announced.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>
#include <functional>
#include <limits>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// A call that is made of something, and what it may be asked.
struct Call {
  std::string name;
  std::vector<ProbabilityMethod> methods;
  std::function<ProbabilityResult(const ProbabilityRequest&)> run;
};

GaussianMixture randomMixture(RandomBodies& random, int count) {
  std::vector<GaussianMixture::Component> components;
  for (int i = 0; i < count; ++i) {
    components.push_back(
        {1.0 / count, randomDisplacement(random, 0.05, 0.3).withMean(0.2 * random.direction())});
  }
  return GaussianMixture(components);
}

/// Pairs and groups of meshes by Gaussians, mixtures and truncated Gaussians.
std::vector<Call> allCalls(unsigned seed) {
  using M = ProbabilityMethod;
  RandomBodies random(seed);
  const auto bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 5, 8, seed));
  const auto torus = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5));
  const auto pair = std::make_shared<PreparedQuery>(bumpy, torus);
  const auto group = std::make_shared<GroupQuery>(GroupQuery::Geometries{bumpy, torus},
                                                  GroupQuery::Geometries{torus, bumpy});
  const fcl::Transform3d pose = at(0.9, 0.1, 0.05);
  const std::vector<fcl::Transform3d> poses_a{kIdentity, at(-0.2, 0, 0)};
  const std::vector<fcl::Transform3d> poses_b{pose, at(1.2, 0.2, 0)};
  const GaussianDisplacement one = randomDisplacement(random, 0.05, 0.3);
  const GaussianMixture mixture = randomMixture(random, 8);
  const TruncatedGaussian cut(one, 2.0);
  const auto of_pair = [=](const auto& displacement) {
    return [=](const ProbabilityRequest& request) {
      ProbabilityResult result;
      collisionProbability(*pair, kIdentity, pose, displacement, request, result);
      return result;
    };
  };
  const auto of_group = [=](const auto& displacement) {
    return [=](const ProbabilityRequest& request) {
      ProbabilityResult result;
      collisionProbability(*group, poses_a, poses_b, displacement, request, result);
      return result;
    };
  };
  return {{"pair",
           {M::interval, M::estimate, M::monte_carlo, M::rare_event, M::general_pcd},
           [=](const ProbabilityRequest& request) {
             ProbabilityResult result;
             pair->collisionProbability(kIdentity, pose, one, request, result);
             return result;
           }},
          {"mixture",
           {M::automatic, M::interval, M::estimate, M::monte_carlo, M::rare_event},
           of_pair(mixture)},
          {"truncated", {M::interval}, of_pair(cut)},
          {"group",
           {M::interval, M::estimate},
           [=](const ProbabilityRequest& request) {
             ProbabilityResult result;
             group->collisionProbability(poses_a, poses_b, one, request, result);
             return result;
           }},
          {"mixture of a group", {M::interval, M::estimate}, of_group(mixture)},
          {"truncated group", {M::interval}, of_group(cut)}};
}

ProbabilityRequest fineRequest(ProbabilityMethod method) {
  ProbabilityRequest request;
  request.method = method;
  request.relative_tolerance = 1e-7;
  request.absolute_tolerance = 0.0;
  request.max_cells = 20'000;
  return request;
}

}  // namespace

TEST_CASE("no call examines more cells or draws more samples than it may") {
  for (const Call& call : allCalls(1)) {
    for (const ProbabilityMethod method : call.methods) {
      for (const std::size_t limit : {1u, 2u, 7u, 64u, 1000u}) {
        ProbabilityRequest request = fineRequest(method);
        request.max_cells = limit;
        request.samples = limit;
        const ProbabilityResult result = call.run(request);
        CAPTURE(call.name, toString(method), limit, toString(result.status));
        const bool sampling =
            method == ProbabilityMethod::monte_carlo || method == ProbabilityMethod::rare_event;
        CHECK(result.statistics.cells <= limit);
        // At least one of each component.
        if (sampling) CHECK(result.statistics.samples <= std::max<std::size_t>(limit, 8));
        CHECK(result.status != ProbabilityStatus::converged);
        if (result.lower) CHECK(*result.lower <= *result.upper);
        if (result.standard_error) CHECK(*result.standard_error > 0.0);
      }
    }
  }
}

TEST_CASE("a call whose time is up or that is cancelled ends at once, and reports as a whole") {
  for (const Call& call : allCalls(2)) {
    for (const ProbabilityMethod method : call.methods) {
      CAPTURE(call.name, toString(method));
      ProbabilityRequest request = fineRequest(method);
      request.max_cells = 3000;
      request.samples = 3000;
      request.time_limit = 1e-9;
      const ProbabilityResult stopped = call.run(request);
      CHECK(stopped.status == ProbabilityStatus::time_limit);
      CHECK(stopped.statistics.cells <= 8);
      CHECK(stopped.statistics.samples <= 8);
      request.time_limit.reset();
      for (const int most : {1, 3, 10}) {
        int calls = 0, after = 0;
        double seconds = 0.0, fraction = 0.0;
        request.on_progress = [&](const ProbabilityProgress& progress) {
          CHECK(progress.seconds >= seconds);
          CHECK(progress.fraction <= 1.0);
          seconds = progress.seconds;
          fraction = progress.fraction;
          after += calls >= most;
          return ++calls < most;
        };
        const ProbabilityResult cancelled = call.run(request);
        CAPTURE(most, calls, fraction);
        CHECK(after == 0);
        if (calls == most) CHECK(cancelled.status == ProbabilityStatus::cancelled);
      }
    }
  }
}

TEST_CASE("a mixture that is stopped holds the one that is not") {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto calls = allCalls(seed);
    for (const std::size_t k : {std::size_t{1}, std::size_t{4}}) {
      ProbabilityRequest request;
      request.method = ProbabilityMethod::interval;
      request.relative_tolerance = 0.3;
      const ProbabilityResult whole = calls[k].run(request);
      for (const std::size_t limit : {1u, 9u, 60u, 700u}) {
        request.max_cells = limit;
        const ProbabilityResult stopped = calls[k].run(request);
        CHECK(*stopped.lower <= *whole.upper);
        CHECK(*stopped.upper >= *whole.lower);
      }
    }
  }
}

TEST_CASE("sampling answers at any distance, in any rank, with any number of samples") {
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const auto ball = std::make_shared<fcl::Sphered>(0.5);
  for (const auto& b : {std::shared_ptr<fcl::CollisionGeometryd>(box),
                        std::shared_ptr<fcl::CollisionGeometryd>(ball)}) {
    const PreparedQuery query(box, b);
    for (double deviations = 30.0; deviations < 46.0; deviations += 0.37) {
      for (int rank = 1; rank <= 3; ++rank) {
        const Eigen::Vector3d sigma(0.1, rank > 1 ? 0.1 : 0.0, rank > 2 ? 0.2 : 0.0);
        ProbabilityRequest request;
        request.method = ProbabilityMethod::rare_event;
        request.samples = 60;
        request.gradient = rank == 3;
        ProbabilityResult result;
        CAPTURE(deviations, rank);
        REQUIRE_NOTHROW(query.collisionProbability(
            kIdentity, at(1.0 + 0.1 * deviations, 0, 0),
            GaussianDisplacement::fromStandardDeviations(sigma), request, result));
        CHECK(*result.estimate >= 0.0);
        CHECK(*result.estimate <= 1e-150);
        CHECK(result.confidence_interval->lower <= *result.estimate);
        CHECK(result.confidence_interval->upper >= *result.estimate);
      }
    }
  }
}

TEST_CASE("numbers at the ends of their ranges are as good as any others") {
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 4, 6, 1));
  const PreparedQuery query(mesh, mesh);
  const GaussianMixture mixture(
      {{0.5, GaussianDisplacement::fromStandardDeviations({0.2, 0.2, 0.2})},
       {0.5, GaussianDisplacement::fromStandardDeviations({0.1, 0.0, 0.0})}});
  const std::vector<std::function<void(ProbabilityRequest&)>> ends = {
      [](auto& r) { r.samples = std::numeric_limits<std::size_t>::max(); },
      [](auto& r) { r.samples = std::numeric_limits<std::size_t>::max() / 2 + 2; },
      [](auto& r) { r.max_cells = std::numeric_limits<std::size_t>::max(); },
      [](auto& r) { r.max_memory = std::numeric_limits<std::size_t>::max(); },
      [](auto& r) { r.max_memory = 1; },
      [](auto& r) { r.threads = std::numeric_limits<unsigned>::max(); },
      [](auto& r) { r.threads = 1u << 31; },
      [](auto& r) { r.confidence = 1.0 - 0x1p-53; },
      [](auto& r) { r.confidence = 1e-300; },
      [](auto& r) { r.seed = std::numeric_limits<std::uint64_t>::max(); },
      [](auto& r) { r.absolute_tolerance = 1e308; },
      [](auto& r) { r.relative_tolerance = 1e308; },
      [](auto& r) { r.threshold = 0.0; },
      [](auto& r) { r.threshold = 1.0; },
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (const std::string& name : methodNames()) {
      ProbabilityRequest request;
      request.method = *methodFromString(name);
      if (request.method == ProbabilityMethod::exact) continue;
      request.samples = 300;
      request.time_limit = 0.005;
      ends[i](request);
      ProbabilityResult result;
      CAPTURE(i, name);
      CHECK_NOTHROW(
          collisionProbability(query, kIdentity, at(1.1, 0, 0), mixture, request, result));
      BatchRequest batch;
      batch.query = request;
      CHECK_NOTHROW(collisionProbabilities(query, std::vector<Waypoint>(2), batch));
    }
  }
}

TEST_CASE("displacements of any size have an answer or a documented refusal") {
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 4, 6, 1));
  const auto ball = std::make_shared<fcl::Sphered>(0.5);
  const auto floor = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), -0.6);
  for (const auto& b : {std::shared_ptr<fcl::CollisionGeometryd>(mesh),
                        std::shared_ptr<fcl::CollisionGeometryd>(ball),
                        std::shared_ptr<fcl::CollisionGeometryd>(floor)}) {
    const PreparedQuery query(mesh, b);
    for (const double sigma : {2e-300, 1e-160, 1e-20, 1e-6, 1e6, 1e20, 1e150}) {
      for (const std::string& name : methodNames()) {
        ProbabilityRequest request;
        request.method = *methodFromString(name);
        request.samples = 50;
        request.max_cells = 200;
        ProbabilityResult result;
        CAPTURE(sigma, name, b->getNodeType());
        try {
          query.collisionProbability(
              kIdentity, at(0.9, 0, 0),
              GaussianDisplacement::fromStandardDeviations({sigma, 0.5 * sigma, sigma}), request,
              result);
        } catch (const UnsupportedGeometry&) {
          CHECK((request.method == ProbabilityMethod::exact || b != mesh));
        } catch (const InvalidRequest&) {
          CHECK(request.method == ProbabilityMethod::rare_event);
          CHECK(sigma < 1e-100);
        }
      }
    }
  }
}

TEST_CASE("the plan says when the absolute tolerance was enough, and only then") {
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 4, 6, 1));
  const PreparedQuery query(mesh, mesh);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const GaussianMixture mixture({{0.5, displacement}, {0.5, displacement}});
  const auto says = [](const ProbabilityResult& result) {
    int count = 0;
    for (const std::string& sentence : result.plan) {
      count += sentence.find("absolute tolerance") != std::string::npos;
    }
    return count;
  };
  for (const ProbabilityMethod method :
       {ProbabilityMethod::automatic, ProbabilityMethod::interval, ProbabilityMethod::estimate}) {
    for (const double distance : {1.0, 1.3, 1.5, 1.7, 2.5}) {
      for (const double tolerance : {0.0, 1e-6, 1e-2}) {
        ProbabilityRequest request;
        request.method = method;
        request.relative_tolerance = 0.1;
        request.absolute_tolerance = tolerance;
        request.max_cells = 20'000;
        ProbabilityResult one, two;
        query.collisionProbability(kIdentity, at(distance, 0, 0), displacement, request, one);
        collisionProbability(query, kIdentity, at(distance, 0, 0), mixture, request, two);
        for (const ProbabilityResult& result : {one, two}) {
          CAPTURE(toString(method), distance, tolerance, *result.lower, *result.upper);
          if (result.status != ProbabilityStatus::converged) continue;
          const bool wide = method == ProbabilityMethod::estimate
                                ? *result.standard_error > 0.1 * *result.estimate
                                : *result.upper - *result.lower > 0.1 * *result.upper;
          CHECK(says(result) == (wide ? 1 : 0));
        }
      }
    }
  }
}
