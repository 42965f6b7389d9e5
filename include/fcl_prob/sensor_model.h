// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How wrong a depth sensor's points are. In the library fcl_prob::cloud.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fcl_prob {

/// Standard deviations of one point, metres: what it has for itself, not what all points share.
struct PointNoise {
  double axial = 0.0;    ///< along the sensor's optical axis
  double lateral = 0.0;  ///< across it
};

/// Noise at a depth (metres, along the optical axis) and an angle of incidence (radians, between
/// the surface's normal and the ray; below π/2). Any function will do.
using SensorModel = std::function<PointNoise(double depth, double incidence)>;

/// Nguyen, Izadi, Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and
/// Tracking", 3DIMPVT 2012: σ_z = 0.0012 + 0.0019 (z - 0.4)², beyond 60° with
/// 0.0001 / √z θ² / (π/2 - θ)² added; σ_L = (0.8 + 0.035 θ / (π/2 - θ)) z / f.
/// \param focal_length  f, pixels
SensorModel nguyenKinect(double focal_length);

/// Khoshelham, Oude Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor Mapping
/// Applications", Sensors 12 (2012), Eq. 12 with their calibration (m / (f b) = 2.85e-5 / cm, σ of
/// the disparity 1/2): σ_z = 1.425e-3 z². They give no lateral deviation apart from what the depth
/// does along the ray: half a pixel here.
SensorModel khoshelhamKinect(double focal_length);

/// Triangulation: σ_z = z² σ_d / (f b); laterally half a pixel.
/// \param focal_length     f, pixels
/// \param baseline         b, metres
/// \param disparity_sigma  σ_d, pixels
SensorModel stereoSensor(double focal_length, double baseline, double disparity_sigma);

/// "kinect-nguyen", "kinect-khoshelham", "stereo" (b = 0.12 m, σ_d = 0.25 pixels) and "exact" (no
/// noise). \throws InvalidRequest naming those that there are
SensorModel sensorModelFromString(const std::string& name, double focal_length);
std::vector<std::string> sensorModelNames();

}  // namespace fcl_prob
