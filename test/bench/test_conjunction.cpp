// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Encounters of satellites against quadrature that shares no code with the library.
#include <fcl/geometry/shape/sphere.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

#include "bench/benchmark.h"
#include "bench/encounters.h"
#include "catch.h"
#include "disc_truth.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "models.h"

using namespace fcl_prob;
using namespace fcl_prob::cli;
using fcl_prob_test::DiscTruth;
using fcl_prob_test::modelOrSkip;
using fcl_prob_test::modelsFolder;
using fcl_prob_test::QuadPrecision;

namespace {

const std::string kHeader = "ID,R [km],...\n";

std::string rowText(const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t k = 0; k < values.size(); ++k) text << (k > 0 ? "," : "") << values[k];
  return text.str() + "\n";
}

// The primary on the x axis, moving along y: radial x, transverse y, normal z. The secondary meets
// it from the side, moving along z: the plane across the relative velocity holds x.
std::string crossing(double id, double miss_km, double sigma_km) {
  const double v = sigma_km * sigma_km;
  return rowText({id,   0.02, 7000, 0, 0,   0, 7.5, 0, v, v, v, 0,   0,   0,   7000 + miss_km,
                  0,    0,    0,    0, 7.5, v, v,   v, 0, 0, 0, 0.1, 0.1, 0.1, miss_km,
                  10.6, 1});
}

Bounds intervalOf(const Encounter& encounter) {
  const fcl::Sphered half(0.5 * encounter.radius);
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = encounter.offset();
  ProbabilityResult result;
  collisionProbability(&half, fcl::Transform3d::Identity(), &half, pose, encounter.displacement(),
                       {}, result);
  CHECK(result.status == ProbabilityStatus::exact);
  return {*result.lower, *result.upper};
}

// The integral over the disc, from the file's numbers by other formulas than the library's.
double truthOf(const Encounter& encounter) {
  const auto inertial = [](const OrbitState& state) -> Eigen::Matrix3d {
    const Eigen::Vector3d r = state.position.normalized();
    const Eigen::Vector3d n = state.position.cross(state.velocity).normalized();
    Eigen::Matrix3d rtn;
    rtn << r, n.cross(r), n;
    return rtn * state.covariance * rtn.transpose();
  };
  const Eigen::Vector3d speed = encounter.secondary.velocity - encounter.primary.velocity;
  const Eigen::Vector3d gap = encounter.secondary.position - encounter.primary.position;
  const Eigen::Vector3d u = gap.cross(speed).normalized(), w = speed.cross(u).normalized();
  Eigen::Matrix<double, 2, 3> plane;
  plane << u.transpose(), w.transpose();
  const Eigen::Matrix2d covariance =
      plane * (inertial(encounter.primary) + inertial(encounter.secondary)) * plane.transpose();
  // Turned to principal axes by one angle.
  const double angle = 0.5 * std::atan2(2 * covariance(0, 1), covariance(0, 0) - covariance(1, 1));
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Eigen::Matrix2d principal = turn.transpose() * covariance * turn;
  const Eigen::Vector2d centre = (turn.transpose() * (plane * gap)).cwiseAbs();
  const int first = principal(0, 0) >= principal(1, 1) ? 0 : 1;
  const DiscTruth<QuadPrecision> truth(centre[first], centre[1 - first], encounter.radius,
                                       std::sqrt(principal(first, first)),
                                       std::sqrt(principal(1 - first, 1 - first)));
  return static_cast<double>(truth.mass());
}

void checkAgainstTruth(const Encounter& encounter) {
  const Bounds bounds = intervalOf(encounter);
  const double truth = truthOf(encounter);
  CAPTURE(encounter.id, bounds.lower, bounds.upper, truth);
  if (truth < 1e-280) return;
  CHECK(bounds.width() <= 1e-10 * bounds.upper);
  // What doubles leave of the projected covariance: two ways round differently.
  const double margin = 1e-11 * (1.0 - 2.0 * std::log(truth));
  CHECK(bounds.lower <= truth * (1 + margin));
  CHECK(bounds.upper >= truth * (1 - margin));
}

}  // namespace

TEST_CASE("made-up encounters are discs under the covariance across the relative velocity",
          "[cli]") {
  std::istringstream table(kHeader + crossing(1, 0.0, 0.1) + crossing(2, 0.15, 0.1) +
                           crossing(3, 1.5, 0.05));
  const std::vector<Encounter> encounters = readEncounters(table, "made up");
  REQUIRE(encounters.size() == 3);
  // Equal deviations: the middle of the first disc is the mean.
  const double sigma = std::sqrt(2.0) * 100.0;
  const double middle = -std::expm1(-0.5 * 20.0 * 20.0 / (sigma * sigma));
  const Bounds first = intervalOf(encounters[0]);
  CHECK(0.5 * (first.lower + first.upper) == Approx(middle).epsilon(1e-9));
  for (const Encounter& encounter : encounters) {
    CHECK(encounter.displacement().rank() == 2);
    if (encounter.id != "1") checkAgainstTruth(encounter);
  }
}

TEST_CASE("covariances along an orbit's own axes turn with it", "[cli]") {
  // Uncertain only along its track, and met head on: nothing is uncertain in the plane but the
  // secondary's radial and normal errors.
  std::istringstream table(
      kHeader +
      rowText({1, 0.02, 0, 7000, 0,    -7.5, 0,      0, 0, 1, 0,   0,   0,   0,    0,  7000.05,
               0, 7.5,  0, 0,    0.01, 4,    0.0004, 0, 0, 0, 0.1, 0.1, 0.1, 0.05, 15, 1}));
  const Encounter encounter = readEncounters(table, "made up").at(0);
  const GaussianDisplacement displacement = encounter.displacement();
  CHECK(displacement.standardDeviations().x() == Approx(100.0));
  CHECK(displacement.standardDeviations().y() == Approx(20.0));
  CHECK(std::abs(displacement.axes().col(0).y()) == Approx(1.0));
  CHECK(encounter.offset().isApprox(Eigen::Vector3d(0, 50, 0)));
  checkAgainstTruth(encounter);
}

TEST_CASE("tables of encounters that are none are refused", "[cli]") {
  const auto read = [](const std::string& text) {
    std::istringstream table(text);
    return readEncounters(table, "table.csv");
  };
  CHECK_THROWS_AS(read(""), FileError);
  CHECK_THROWS_WITH(read(kHeader + "1,2,3\n"), "table.csv, line 2: 3 columns instead of 32");
  std::string words = crossing(1, 0.1, 0.1);
  words.replace(words.find("7000"), 4, "far");
  CHECK_THROWS_WITH(read(kHeader + words), "table.csv, line 2: 'far' is not a number");
}

TEST_CASE("real encounters agree with quadrature, and none is left out", "[cli]") {
  const auto path = modelOrSkip("conjunctions/data.csv");
  if (!path) return;
  std::ifstream file(*path);
  const std::vector<Encounter> encounters = readEncounters(file, *path);
  REQUIRE(encounters.size() == 2170);
  const std::vector<double> known{0.13618761, 0.12543442, 0.03720977, 0.02425226};
  for (std::size_t k = 0; k < known.size(); ++k) {
    CHECK(intervalOf(encounters[k]).middle() == Approx(known[k]).margin(6e-9));
  }
  std::mt19937 random(1);
  for (int k = 0; k < 50; ++k) {
    checkAgainstTruth(encounters[std::uniform_int_distribution<std::size_t>(0, 2169)(random)]);
  }
  BenchOptions options;
  options.models_folder = *modelsFolder();
  const BenchReport report =
      benchConjunction(options, [](double, const std::string&) { return true; });
  CHECK(report.records.size() == 2170);
  for (const auto& record : report.records) CHECK(record["status"] == "exact");
}
