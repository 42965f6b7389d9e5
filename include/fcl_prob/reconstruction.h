// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From a point cloud to meshes and their errors. In the library fcl_prob::cloud.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/band.h"
#include "fcl_prob/point_cloud.h"
#include "fcl_prob/sensor_model.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob {

/// What is made of space that the sensor did not see: behind surfaces and in holes.
enum class UnseenSpace {
  free,      ///< nothing is there
  occupied,  ///< the shadow of the surface, and holes in it, belong to the obstacle
  report     ///< as `free`, and said so in the notes
};

/// How clouds that are no image become a mesh.
enum class PointMeshing { greedy, poisson };

struct ReconstructionRequest {
  SensorModel sensor;           ///< empty: nguyenKinect(focal_length)
  double focal_length = 525.0;  ///< of the sensor, pixels; used where the cloud is no image

  /// Only what is within it, in the frame of the points.
  std::optional<Eigen::AlignedBox3d> crop;

  /// Leaves out the largest plane, a table or floor, and what is closer to it than
  /// plane_tolerance (metres).
  bool remove_plane = false;
  double plane_tolerance = 0.01;

  /// Surfaces of fewer points are taken for outliers.
  std::size_t least_points = 50;

  /// Points are averaged with those up to so many pixels away on the same surface.
  int window = 2;

  /// The mesh of an image may leave out detail up to this deviation from the averaged points,
  /// metres; the deviation is measured and becomes part of the band. Null: a tenth of what the band
  /// is without, and at least 1 mm.
  std::optional<double> simplification;

  UnseenSpace unseen = UnseenSpace::report;
  double shadow_depth = 0.3;  ///< how far behind the surface the shadow reaches, metres

  /// Probability with which the band is to hold, all along the surface.
  double coverage = 0.95;

  PointMeshing meshing = PointMeshing::greedy;

  /// Covariance of the sensor's pose: translation (metres) and rotation vector (radians) in the
  /// frame of the points, about the sensor's origin. All points share it.
  Eigen::Matrix<double, 6, 6> sensor_pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();

  /// Told how much is done, 0 to 1; returning false cancels (InvalidRequest).
  std::function<bool(double)> on_progress;
};

/// One connected surface.
struct ReconstructedRegion {
  std::size_t points = 0;
  double band = 0.0;  ///< metres: the largest of its points
  Eigen::AlignedBox3d box;
};

/// Meshes in the frame of the points, and two kinds of errors that must not be mixed: what points
/// have for themselves is a band around the surface; what all of them share is a displacement.
struct Reconstruction {
  TriangleMesh surface;   ///< what was seen: an open surface, metres
  TriangleMesh obstacle;  ///< what may be there: with its margins, and the shadow if asked for

  /// Of both meshes: `outward` of `obstacle`, from which upper bounds follow, and `inward` of
  /// `surface`, from which lower bounds follow.
  Band band;
  double deviation = 0.0;  ///< metres: of the simplified surface from the averaged points, measured

  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< middle of the surface
  Eigen::Matrix<double, 6, 6> pose_covariance;          ///< shared error, about `reference`
  Eigen::Matrix3d covariance;                           ///< of it, the displacement of `reference`

  bool obstacle_is_solid = false;  ///< `obstacle` is closed: ask with contact = solid
  double share_used = 0.0;         ///< of the finite points
  double largest_hole = 0.0;       ///< metres across, within a surface; 0 where none was found
  std::optional<Eigen::Vector4d> plane;  ///< removed: unit normal n and d, n·x = d
  std::vector<ReconstructedRegion> regions;
  std::vector<std::string> notes;  ///< what was decided, one sentence each
  std::vector<std::pair<std::string, double>> seconds;
};

/// \throws InvalidRequest; InvalidGeometry where too little of the cloud is left to make a surface
///         of
Reconstruction reconstruct(const PointCloud& cloud, const ReconstructionRequest& request);

/// Σ of a point's displacement under an error of a pose: J Σ Jᵀ, J = [1, -[x - o]×], with o what
/// the rotation is about.
Eigen::Matrix<double, 6, 6> carriedTo(const Eigen::Vector3d& x, const Eigen::Vector3d& o,
                                      const Eigen::Matrix<double, 6, 6>& covariance);

/// All of it but the meshes, as JSON; `surface` and `obstacle` are the mesh files, relative to it.
std::string toJson(const Reconstruction& reconstruction, const std::string& surface,
                   const std::string& obstacle);

/// The mesh as a Wavefront file (OBJ).
std::string toObj(const TriangleMesh& mesh);

}  // namespace fcl_prob
