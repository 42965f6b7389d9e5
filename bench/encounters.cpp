// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/encounters.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <locale>
#include <sstream>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {
namespace {

constexpr std::size_t kColumns = 32;
constexpr double kKilometre = 1000.0;

using Values = std::array<double, kColumns>;

[[noreturn]] void refuse(const std::string& name, std::size_t line, const std::string& why) {
  throw FileError(name + ", line " + std::to_string(line) + ": " + why);
}

double numberOf(const std::string& word, const std::string& name, std::size_t line) {
  std::istringstream text(word);
  text.imbue(std::locale::classic());
  double value = 0.0;
  if (!(text >> value) || !(text >> std::ws).eof() || !std::isfinite(value)) {
    refuse(name, line, "'" + word + "' is not a number");
  }
  return value;
}

Values rowOf(const std::string& text, const std::string& name, std::size_t line) {
  std::istringstream words(text);
  std::string word;
  Values row{};
  std::size_t count = 0;
  while (std::getline(words, word, ',')) {
    if (count < kColumns) row[count] = numberOf(word, name, line);
    ++count;
  }
  if (count != kColumns) {
    refuse(name, line, std::to_string(count) + " columns instead of " + std::to_string(kColumns));
  }
  return row;
}

OrbitState stateOf(const double* columns) {
  OrbitState state;
  state.position = kKilometre * Eigen::Vector3d(columns[0], columns[1], columns[2]);
  state.velocity = kKilometre * Eigen::Vector3d(columns[3], columns[4], columns[5]);
  const double rr = columns[6], tt = columns[7], nn = columns[8];
  const double rt = columns[9], rn = columns[10], tn = columns[11];
  state.covariance << rr, rt, rn, rt, tt, tn, rn, tn, nn;
  state.covariance *= kKilometre * kKilometre;
  return state;
}

/// Across the relative velocity: the two axes of the plane and the velocity's direction.
Eigen::Matrix3d encounterFrame(const Encounter& encounter) {
  const Eigen::Vector3d along =
      (encounter.secondary.velocity - encounter.primary.velocity).normalized();
  Eigen::Matrix3d frame;
  frame.col(0) = along.unitOrthogonal();
  frame.col(1) = along.cross(frame.col(0));
  frame.col(2) = along;
  return frame;
}

}  // namespace

Eigen::Matrix3d OrbitState::axes() const {
  Eigen::Matrix3d axes;
  axes.col(0) = position.normalized();
  axes.col(2) = position.cross(velocity).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Eigen::Vector3d Encounter::offset() const {
  const Eigen::Matrix3d frame = encounterFrame(*this);
  const Eigen::Vector3d gap = secondary.position - primary.position;
  return frame.leftCols<2>() * (frame.leftCols<2>().transpose() * gap);
}

GaussianDisplacement Encounter::displacement() const {
  const Eigen::Matrix3d p = primary.axes(), s = secondary.axes();
  const Eigen::Matrix3d sum =
      p * primary.covariance * p.transpose() + s * secondary.covariance * s.transpose();
  const Eigen::Matrix3d frame = encounterFrame(*this);
  const Eigen::Matrix2d plane = frame.leftCols<2>().transpose() * sum * frame.leftCols<2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(plane);
  const Eigen::Vector2d variances = solver.eigenvalues();
  if (!(variances.minCoeff() >= 0.0)) {
    throw InvalidDistribution("encounter " + id + ": the covariance has a negative eigenvalue");
  }
  // A rotation: the plane's axes, largest deviation first, and the direction in which nothing
  // moves.
  Eigen::Matrix3d axes;
  axes.col(0) = frame.leftCols<2>() * solver.eigenvectors().col(1);
  axes.col(2) = frame.col(2);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return GaussianDisplacement::fromStandardDeviations(
      {std::sqrt(variances[1]), std::sqrt(variances[0]), 0.0}, Eigen::Quaterniond(axes));
}

std::vector<Encounter> readEncounters(std::istream& table, const std::string& name) {
  std::string text;
  if (!std::getline(table, text)) refuse(name, 1, "no header");
  std::vector<Encounter> encounters;
  for (std::size_t line = 2; std::getline(table, text); ++line) {
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (text.empty()) continue;
    const Values row = rowOf(text, name, line);
    Encounter encounter;
    encounter.id = text.substr(0, text.find(','));
    encounter.radius = kKilometre * row[1];
    if (!(encounter.radius > 0.0)) refuse(name, line, "the radius is not positive");
    encounter.primary = stateOf(&row[2]);
    encounter.secondary = stateOf(&row[14]);
    encounter.stated = row[26];
    encounter.approximation = row[27];
    encounter.maximum = row[28];
    encounters.push_back(encounter);
  }
  return encounters;
}

}  // namespace fcl_prob::cli
