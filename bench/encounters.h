// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Encounters of two satellites as pairs of spheres under an error across their relative velocity.
#pragma once

#include <Eigen/Core>
#include <istream>
#include <string>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::cli {

/// Position and velocity (metres, metres a second; inertial frame) and the position's covariance
/// along its own radial, transverse and normal axes (square metres).
struct OrbitState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Columns: radial (along the position), transverse, normal (along position × velocity).
  Eigen::Matrix3d axes() const;
};

struct Encounter {
  std::string id;
  double radius = 0.0;  ///< sum of both
  OrbitState primary, secondary;
  double stated = 0.0;         ///< by numerical integration
  double approximation = 0.0;  ///< by a density that is constant over the disc
  double maximum = 0.0;        ///< over all scales of the covariance

  /// From the primary to the secondary, in the plane across the relative velocity (metres, inertial
  /// frame).
  Eigen::Vector3d offset() const;

  /// Of the primary relative to the secondary in that plane: rank 2. An encounter is so short that
  /// motion is a straight line, along which any error only changes when they meet.
  GaussianDisplacement displacement() const;
};

/// A table in the format of Orekit's test data (CS-SI/Orekit,
/// src/test/resources/collision-resources/data.csv): a header and 32 columns, kilometres.
/// \throws FileError with the line and what is wrong with it
std::vector<Encounter> readEncounters(std::istream& table, const std::string& name);

}  // namespace fcl_prob::cli
