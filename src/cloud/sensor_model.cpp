// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/sensor_model.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace {

constexpr double kRightAngle = 1.5707963267948966;
constexpr double kSteep = kRightAngle * 2.0 / 3.0;  // 60°

// Closer to a right angle the quotients of the models are of no use.
constexpr double kLeastOfRightAngle = 0.02;

void requirePositive(const char* name, double value) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InvalidRequest(std::string(name) + " is " + detail::numberText(value) +
                       ", must be finite and > 0");
}

}  // namespace

SensorModel nguyenKinect(double focal_length) {
  requirePositive("focal_length", focal_length);
  return [focal_length](double depth, double incidence) {
    const double left = std::max(kRightAngle - incidence, kLeastOfRightAngle);
    PointNoise noise;
    noise.axial = 0.0012 + 0.0019 * (depth - 0.4) * (depth - 0.4);
    if (incidence > kSteep) {
      noise.axial += 0.0001 / std::sqrt(depth) * incidence * incidence / (left * left);
    }
    noise.lateral = (0.8 + 0.035 * incidence / left) * depth / focal_length;
    return noise;
  };
}

SensorModel khoshelhamKinect(double focal_length) {
  requirePositive("focal_length", focal_length);
  return [focal_length](double depth, double) {
    return PointNoise{1.425e-3 * depth * depth, 0.5 * depth / focal_length};
  };
}

SensorModel stereoSensor(double focal_length, double baseline, double disparity_sigma) {
  requirePositive("focal_length", focal_length);
  requirePositive("baseline", baseline);
  requirePositive("disparity_sigma", disparity_sigma);
  return [=](double depth, double) {
    return PointNoise{depth * depth * disparity_sigma / (focal_length * baseline),
                      0.5 * depth / focal_length};
  };
}

SensorModel sensorModelFromString(const std::string& name, double focal_length) {
  if (name == "kinect-nguyen") return nguyenKinect(focal_length);
  if (name == "kinect-khoshelham") return khoshelhamKinect(focal_length);
  if (name == "stereo") return stereoSensor(focal_length, 0.12, 0.25);
  if (name == "exact") return [](double, double) { return PointNoise{}; };
  std::string known;
  for (const std::string& one : sensorModelNames()) known += " " + one;
  throw InvalidRequest("unknown sensor '" + name + "'; known are" + known);
}

std::vector<std::string> sensorModelNames() {
  return {"kinect-nguyen", "kinect-khoshelham", "stereo", "exact"};
}

}  // namespace fcl_prob
