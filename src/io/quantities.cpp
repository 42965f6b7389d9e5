// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/quantities.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "gaussian/named_values.h"
#include "gaussian/rotation.h"
#include "geometry/validation.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

bool allFinite(const Numbers& numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) return false;
  }
  return true;
}

}  // namespace

Numbers numberList(const std::string& text) {
  Numbers numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view word = std::string_view(text).substr(begin, end - begin);
    const std::optional<double> number = parseNumber(word);
    if (!number) throw InvalidRequest(inQuotes(word) + " is not a number");
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

Eigen::Quaterniond quaternionFrom(const Numbers& numbers) {
  if (numbers.size() != 4 || !allFinite(numbers)) {
    throw InvalidPose("a quaternion needs 4 finite numbers w,x,y,z, not " +
                      std::to_string(numbers.size()));
  }
  Eigen::Vector4d coefficients(numbers[1], numbers[2], numbers[3], numbers[0]);
  const double largest = coefficients.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) throw InvalidPose("a quaternion of zeros is no rotation");
  coefficients = (coefficients / largest).normalized();
  return Eigen::Quaterniond(coefficients);
}

fcl::Transform3d poseFrom(const Numbers& numbers) {
  const std::size_t count = numbers.size();
  if ((count != 3 && count != 6 && count != 7 && count != 12) || !allFinite(numbers)) {
    throw InvalidPose(
        "a pose needs 3, 6, 7 or 12 finite numbers x,y,z[,roll,pitch,yaw or ,qw,qx,qy,qz], or the "
        "rows of a 3 x 4 matrix, not " +
        std::to_string(count));
  }
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  if (count == 12) {
    pose.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
    validatePose(pose, "twelve numbers");
    return pose;
  }
  pose.translation() = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  if (count == 6) pose.linear() = rotationOfAngles({numbers[3], numbers[4], numbers[5]}, "a pose");
  if (count == 7) {
    pose.linear() = quaternionFrom({numbers.begin() + 3, numbers.end()}).toRotationMatrix();
  }
  return pose;
}

Eigen::Vector3d vectorFrom(const Numbers& numbers, const std::string& name) {
  if (numbers.size() != 3) {
    throw InvalidRequest(name + " needs 3 numbers, not " + std::to_string(numbers.size()));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Matrix3d covarianceFrom(const Numbers& numbers) {
  if (numbers.size() != 6) {
    throw InvalidDistribution("a covariance needs 6 numbers xx,xy,xz,yy,yz,zz, not " +
                              std::to_string(numbers.size()));
  }
  Eigen::Matrix3d covariance;
  covariance << numbers[0], numbers[1], numbers[2],  //
      numbers[1], numbers[3], numbers[4],            //
      numbers[2], numbers[4], numbers[5];
  return covariance;
}

Band bandFrom(const Numbers& numbers) {
  if (numbers.empty() || numbers.size() > 2) {
    throw InvalidRequest("a band needs 1 or 2 numbers, not " + std::to_string(numbers.size()));
  }
  for (const double number : numbers) {
    if (!std::isfinite(number) || number < 0.0) {
      throw InvalidRequest("a band of " + numberText(number) +
                           " m: must be finite and not negative");
    }
  }
  return {numbers.front(), numbers.back()};
}

PoseError::Vector6 sixFrom(const Numbers& numbers, const std::string& name) {
  if (numbers.size() != 6) {
    throw InvalidRequest(name + " needs 6 numbers x,y,z,rx,ry,rz, not " +
                         std::to_string(numbers.size()));
  }
  return Eigen::Map<const PoseError::Vector6>(numbers.data());
}

PoseError::Matrix6 poseCovarianceFrom(const Numbers& numbers) {
  if (numbers.size() == 36) {
    std::array<double, 36> rows;
    std::copy(numbers.begin(), numbers.end(), rows.begin());
    return PoseError::fromRosCovariance(rows).covariance();
  }
  if (numbers.size() != 21) {
    throw InvalidDistribution(
        "a pose covariance needs 36 numbers, or 21, its upper triangle row by row, not " +
        std::to_string(numbers.size()));
  }
  PoseError::Matrix6 covariance;
  std::size_t next = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      covariance(row, column) = covariance(column, row) = numbers[next++];
    }
  }
  return covariance;
}

PoseError poseErrorFrom(const PoseError::Vector6& sigma, PoseConvention convention,
                        const PoseError::Vector6& mean) {
  const PoseError centred =
      PoseError::fromStandardDeviations(sigma.head<3>(), sigma.tail<3>(), convention);
  if (mean.isZero(0)) return centred;
  return PoseError(centred.covariance(), convention, mean);
}

std::optional<PoseConvention> poseConventionFromString(const std::string& name) {
  return valueOf(kPoseConventions, name);
}
std::string toString(PoseConvention convention) { return nameOf(kPoseConventions, convention); }

std::optional<ContactMeaning> contactFromString(const std::string& name) {
  return valueOf(kContactMeanings, name);
}
std::string toString(ContactMeaning contact) { return nameOf(kContactMeanings, contact); }

}  // namespace fcl_prob::detail
