// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is written for others to check: that it is whole, repeats, and says no more than the query.
// Whether the claims hold is for verify/ and the audit.
#include "fcl_prob/certificate.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>
#include <sstream>

#include "catch.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

// Named: files of a room may be compiled as one.
namespace certificate_test {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

struct Certified {
  ProbabilityResult result;
  std::vector<std::string> lines;
};

fcl::CollisionObjectd placed(const Geometry& geometry, const Eigen::Vector3d& at) {
  return {geometry, Eigen::Matrix3d::Identity(), at};
}

Certified certify(const std::vector<fcl::CollisionObjectd>& a,
                  const std::vector<fcl::CollisionObjectd>& b,
                  const GaussianDisplacement& displacement,
                  const ProbabilityRequest& request = {}) {
  const auto pointers = [](const std::vector<fcl::CollisionObjectd>& objects) {
    std::vector<const fcl::CollisionObjectd*> all;
    for (const auto& object : objects) all.push_back(&object);
    return all;
  };
  std::stringstream text;
  Certified certified;
  certifiedProbability(pointers(a), pointers(b), displacement, request, text, certified.result);
  for (std::string line; std::getline(text, line);) certified.lines.push_back(line);
  return certified;
}

std::size_t count(const Certified& certified, const std::string& what) {
  std::size_t found = 0;
  for (const std::string& line : certified.lines) found += line.find(what) != std::string::npos;
  return found;
}

GaussianDisplacement normal(double x, double y, double z) {
  return GaussianDisplacement::fromStandardDeviations({x, y, z});
}

const Geometry box = std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2);

}  // namespace

TEST_CASE("The certificate of two boxes") {
  // They touch where each coordinate of the displacement is within 0.2 of where they are one.
  const Certified certified =
      certify({placed(box, {0.25, 0, 0})}, {placed(box, {0, 0, 0})}, normal(0.1, 0.1, 0.1));
  const auto mass = [](double lo, double hi) {
    return 0.5 * (std::erf(hi / std::sqrt(2.0)) - std::erf(lo / std::sqrt(2.0)));
  };
  const double p = mass(-4.5, -0.5) * mass(-2, 2) * mass(-2, 2);
  CHECK(*certified.result.lower <= p + 1e-12);
  CHECK(*certified.result.upper >= p - 1e-12);
  CHECK(*certified.result.upper - *certified.result.lower <= 0.0101 * p);
  CHECK(certified.lines[0].find(R"({"fcl_prob_certificate":1,"name":"group A and group B",)") == 0);
  CHECK(count(certified, R"({"part":"A")") == 1);
  CHECK(count(certified, R"({"part":"B")") == 1);
  CHECK(count(certified, R"("by":{"pair":[0,0]})") > 0);
  CHECK(count(certified, R"("free":true)") > 0);
  const std::string& last = certified.lines.back();
  CHECK(last.find(R"({"lower":)") == 0);
  const std::string cells = R"("cells":)" + std::to_string(count(certified, R"({"cell":[)")) + "}";
  CHECK(last.find(cells) != std::string::npos);
}

TEST_CASE("Certificates repeat, and limits end them whole") {
  const Geometry bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 12, 16, 3));
  ProbabilityRequest request;
  request.max_cells = 200;
  request.relative_tolerance = 1e-4;
  const auto ask = [&] {
    return certify({placed(bumpy, {0.5, 0.1, 0})}, {placed(bumpy, {0, 0, 0})},
                   normal(0.05, 0.1, 0.08), request);
  };
  const Certified first = ask();
  CHECK(first.result.status == ProbabilityStatus::cell_limit);
  CHECK(first.lines == ask().lines);
  CHECK(first.lines.back().find(R"({"lower":)") == 0);
}

TEST_CASE("Certified answers agree with others: groups, solids, ranks") {
  const Geometry bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 12, 16, 3));
  const Geometry small = makeModel<fcl::OBBRSSd>(boxMesh({0.1, 0.1, 0.1}));
  for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
    for (const GaussianDisplacement& displacement :
         {normal(0.2, 0.15, 0.1), normal(0.2, 0.1, 0), normal(0.2, 0, 0)}) {
      ProbabilityRequest request;
      request.contact = contact;
      const std::vector<fcl::CollisionObjectd> a{placed(small, {0.1, 0, 0}),
                                                 placed(box, {0.6, 0.1, 0})};
      const std::vector<fcl::CollisionObjectd> b{placed(bumpy, {0, 0, 0})};
      const Certified certified = certify(a, b, displacement, request);
      ProbabilityResult other;
      collisionProbability({&a[0], &a[1]}, {&b[0]}, displacement, request, other);
      CHECK(*certified.result.lower <= *other.upper);
      CHECK(*certified.result.upper >= *other.lower);
      CHECK(count(certified, R"({"part":"A")") == 2);
      if (contact == ContactMeaning::fcl) CHECK(count(certified, "contained") == 0);
    }
  }
}

TEST_CASE("Certificates of spheres, capsules and polytopes beside anything") {
  const Geometry bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 8, 10, 3));
  const Geometry sphere = std::make_shared<fcl::Sphered>(0.1);
  const Geometry capsule = std::make_shared<fcl::Capsuled>(0.08, 0.3);
  const Geometry convex = convexGeometry(convexHull(bumpyMesh(0.2, 5, 6, 3).vertices));
  for (const Geometry& rounded : {sphere, capsule, convex}) {
    for (const Geometry& other : {sphere, capsule, box, bumpy}) {
      for (const GaussianDisplacement& displacement :
           {normal(0.1, 0.15, 0.1), normal(0.1, 0.2, 0)}) {
        ProbabilityRequest request;
        request.relative_tolerance = 0.1;
        const std::vector<fcl::CollisionObjectd> a{placed(rounded, {0.35, 0.05, 0.1})};
        const std::vector<fcl::CollisionObjectd> b{placed(other, {0, 0, 0})};
        const Certified certified = certify(a, b, displacement, request);
        ProbabilityResult exact;
        collisionProbability({&a[0]}, {&b[0]}, displacement, request, exact);
        CHECK(*certified.result.lower <= *exact.upper);
        CHECK(*certified.result.upper >= *exact.lower);
        CHECK(certified.result.status == ProbabilityStatus::converged);
        CHECK(certified.lines[0].find(R"({"fcl_prob_certificate":2,)") == 0);
        const std::size_t of_a = rounded == convex ? 0 : 1;
        const std::size_t of_b = other == box || other == bumpy ? 0 : 1;
        CHECK(count(certified, R"("radius":)") == of_a + of_b);
      }
    }
  }
}

TEST_CASE("Certificates of displacements of which nothing is random") {
  const Geometry bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.3, 8, 10, 3));
  const std::vector<fcl::CollisionObjectd> a{placed(box, {0, 0, 0})}, b{placed(bumpy, {0, 0, 0})};
  for (const double x : {0.05, 0.25, 0.35, 0.6}) {
    for (const ContactMeaning contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
      ProbabilityRequest request;
      request.contact = contact;
      const Certified certified = certify(a, b, normal(0, 0, 0).withMean({x, 0.01, 0.02}), request);
      ProbabilityResult other;
      collisionProbability({&a[0]}, {&b[0]}, normal(0, 0, 0).withMean({x, 0.01, 0.02}), request,
                           other);
      CHECK(*certified.result.lower == Approx(*other.lower).margin(1e-12));
      CHECK(*certified.result.upper == Approx(*other.upper).margin(1e-12));
      CHECK(certified.lines[0].find(R"({"fcl_prob_certificate":2,)") == 0);
      CHECK(count(certified, *other.lower == 1.0 ? R"("contact":[{)" : R"("free":true)") == 1);
    }
  }
}

TEST_CASE("What no certificate can be written of") {
  const auto at = [](const Geometry& geometry) { return placed(geometry, {0.3, 0, 0}); };
  const auto cone = std::make_shared<fcl::Coned>(0.1, 0.1);
  const auto half_space = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitZ(), 0.0);
  const GaussianDisplacement error = normal(0.1, 0.1, 0.1);
  CHECK_THROWS_AS(certify({at(cone)}, {at(box)}, error), UnsupportedGeometry);
  CHECK_THROWS_WITH(certify({at(box)}, {at(box), at(cone)}, error),
                    Catch::Matchers::Contains("member 1 of group B: Cone"));
  CHECK_THROWS_AS(certify({at(box)}, {at(half_space)}, error), UnsupportedGeometry);
  CHECK_THROWS_AS(certify({at(box)}, {at(box)}, normal(0.1, 0.1, 1e-40)), InvalidRequest);
  const auto absent = std::make_shared<fcl::Boxd>(0.2, 0.2, 0.2);
  absent->cost_density = 0.0;  // not occupied: fcl::collide leaves it out
  CHECK_THROWS_AS(certify({at(absent)}, {at(box)}, error), UnsupportedGeometry);
  const auto tree = std::make_shared<octomap::OcTree>(0.1);
  tree->updateNode(octomap::point3d(0, 0, 0), false);
  const auto nothing = std::make_shared<fcl::OcTreed>(tree);
  CHECK_THROWS_WITH(certify({at(box)}, {at(nothing)}, error),
                    Catch::Matchers::Contains("group B: nothing of it is occupied"));
  ProbabilityResult unused;
  std::ostringstream text;
  CHECK_THROWS_AS(certifiedProbability({nullptr}, {nullptr}, error, {}, text, unused),
                  InvalidGeometry);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  CHECK_THROWS_AS(certify({at(box)}, {at(box)}, error, request), InvalidRequest);
  request = {};
  request.band_a = {0.01, 0.01};
  CHECK_THROWS_AS(certify({at(box)}, {at(box)}, error, request), InvalidRequest);
  request = {};
  request.gradient = true;
  CHECK_THROWS_AS(certify({at(box)}, {at(box)}, error, request), InvalidRequest);
}

}  // namespace certificate_test
