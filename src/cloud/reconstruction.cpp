// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/reconstruction.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "base/number_text.h"
#include "base/quantiles.h"
#include "cloud/depth_grid.h"
#include "cloud/grid_mesh.h"
#include "cloud/median.h"
#include "cloud/points_mesh.h"
#include "fcl_prob/exceptions.h"
#include "gaussian/rotation.h"

namespace fcl_prob {
namespace detail {
namespace {

// Pixels seen more steeply are no certain part of the surface, radians.
constexpr double kSteepestCertain = 1.3;

// Nor are those with a band so many times that of the middle one: edges, with few neighbours.
constexpr double kWidestBand = 2.5;

// What a mesh of an image may deviate from its averaged points by: a length in metres, and as a
// share of the band.
constexpr double kLeastSimplification = 0.001;
constexpr double kShareOfBand = 0.1;

// What lies between pixels, as a share of their distance.
constexpr double kBetweenPixels = 0.5;

void requireInRange(const char* field, double value, double from, double to) {
  if (value >= from && value <= to) return;
  throw InvalidRequest(std::string(field) + " is " + numberText(value) + ", must be from " +
                       numberText(from) + " to " + numberText(to));
}

void validate(const ReconstructionRequest& request) {
  requireInRange("focal_length", request.focal_length, 1.0, 1e6);
  requireInRange("plane_tolerance", request.plane_tolerance, 1e-6, 1e3);
  requireInRange("window", request.window, 0, 20);
  if (request.simplification) requireInRange("simplification", *request.simplification, 0.0, 1e3);
  requireInRange("shadow_depth", request.shadow_depth, 1e-6, 1e3);
  requireInRange("coverage", request.coverage, 0.0, 1.0 - 1e-9);
  if (!request.sensor_pose_covariance.allFinite()) {
    throw InvalidRequest("sensor_pose_covariance is not finite");
  }
}

/// How many deviations hold `count` independent errors at once.
double deviationsFor(double coverage, double count) {
  const double missed = (1.0 - coverage) / std::max(count, 1.0);
  return std::sqrt(2.0) * erfcInverse(missed);
}

class Reconstructor {
 public:
  Reconstructor(const PointCloud& cloud, const ReconstructionRequest& request)
      : cloud_(cloud), request_(request), keep_(cloud.points.size(), 0) {
    validate(request);
    if (cloud.points.size() != cloud.width * cloud.height) {
      throw InvalidGeometry("a cloud of " + std::to_string(cloud.points.size()) +
                            " points is not " + std::to_string(cloud.width) + " x " +
                            std::to_string(cloud.height));
    }
    sensor_ = request.sensor ? request.sensor : nguyenKinect(request.focal_length);
  }

  Reconstruction run() {
    select();
    finish("selection", 0.2);
    if (cloud_.isOrganised()) {
      ofImage();
    } else {
      ofPoints();
    }
    if (result_.surface.triangles.empty()) {
      throw InvalidGeometry("the " + std::to_string(used_) +
                            " points that are left make no surface");
    }
    shareErrors();
    result_.share_used =
        finite_ > 0 ? static_cast<double>(used_) / static_cast<double>(finite_) : 0.0;
    return std::move(result_);
  }

 private:
  void finish(const std::string& stage, double done) {
    const auto now = std::chrono::steady_clock::now();
    result_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
    if (request_.on_progress && !request_.on_progress(done)) {
      throw InvalidRequest("the reconstruction was cancelled");
    }
  }

  void note(const std::string& sentence) { result_.notes.push_back(sentence); }

  // Finite, within the crop, and not of the plane.
  void select() {
    Points kept;
    for (std::size_t i = 0; i < cloud_.points.size(); ++i) {
      if (!cloud_.points[i].allFinite()) continue;
      ++finite_;
      keep_[i] = !request_.crop || request_.crop->contains(cloud_.points[i]);
      if (keep_[i]) kept.push_back(cloud_.points[i]);
    }
    if (kept.size() < 4) {
      throw InvalidGeometry("only " + std::to_string(kept.size()) + " of " +
                            std::to_string(finite_) + " finite points are in the crop: too few");
    }
    if (request_.remove_plane) removePlane(kept);
  }

  void removePlane(const Points& kept) {
    result_.plane = largestPlane(kept, request_.plane_tolerance);
    if (!result_.plane) return note("no plane was found to remove");
    std::size_t removed = 0;
    for (std::size_t i = 0; i < keep_.size(); ++i) {
      if (!keep_[i]) continue;
      const double off = result_.plane->head<3>().dot(cloud_.points[i]) - (*result_.plane)[3];
      if (std::fabs(off) > request_.plane_tolerance) continue;
      keep_[i] = 0;
      ++removed;
    }
    note("a plane of " + std::to_string(removed) + " points was removed");
  }

  void ofImage() {
    DepthGrid grid = depthGrid(cloud_, keep_);
    judgeNoise(sensor_, grid);
    findRegions(request_.least_points, grid);
    const double averaged = average(request_.window, grid);
    const std::vector<std::size_t> sizes = findRegions(request_.least_points, grid);
    for (const std::size_t size : sizes) used_ += size;
    if (used_ == 0) return;
    finish("averaging", 0.5);
    result_.largest_hole = largestHole(grid);
    const std::vector<double> bands = bandsOf(grid, averaged);
    DepthGrid certain = grid;
    const double widest = keepCertain(bands, certain);
    const double allowed =
        request_.simplification.value_or(std::max(kLeastSimplification, kShareOfBand * widest));
    GridMesh surface = meshOf(certain, allowed, false);
    result_.surface = std::move(surface.mesh);
    result_.deviation = surface.deviation;
    finish("mesh", 0.8);
    const double obstacle_deviation = makeObstacle(grid, allowed);
    const double between = kBetweenPixels * typicalPitch(grid);
    result_.band = {widest + between + obstacle_deviation, widest + between + surface.deviation};
    addRegions(grid, bands, sizes);
    finish("obstacle", 1.0);
    note("meshed as the sensor's image, averaged over " + numberText(std::round(averaged)) +
         " pixels");
  }

  // Across the surface, for errors along the depth.
  std::vector<double> bandsOf(const DepthGrid& grid, double averaged) const {
    const double factor = deviationsFor(request_.coverage, static_cast<double>(used_) / averaged);
    std::vector<double> bands(grid.size(), 0.0);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (!(grid.inverse[i] > 0.0)) continue;
      bands[i] = factor * grid.deviation[i] * grid.rays[i].norm() * std::cos(grid.incidence[i]);
    }
    return bands;
  }

  // Leaves the pixels that are certainly of the surface, and returns the widest of their bands.
  static double keepCertain(const std::vector<double>& bands, DepthGrid& grid) {
    std::vector<double> sorted;
    for (std::size_t i = 0; i < bands.size(); ++i) {
      if (grid.inverse[i] > 0.0) sorted.push_back(bands[i]);
    }
    const double most = kWidestBand * median(std::move(sorted));
    double widest = 0.0;
    for (std::size_t i = 0; i < bands.size(); ++i) {
      if (!(grid.inverse[i] > 0.0)) continue;
      if (grid.incidence[i] > kSteepestCertain || bands[i] > most) {
        grid.inverse[i] = 0.0;
      } else {
        widest = std::max(widest, bands[i]);
      }
    }
    return widest;
  }

  static double typicalPitch(const DepthGrid& grid) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const double inverse : grid.inverse) {
      if (!(inverse > 0.0)) continue;
      sum += grid.pitch / inverse;
      ++count;
    }
    return count == 0 ? 0.0 : sum / static_cast<double>(count);
  }

  // The surface may reach beyond its outermost pixels by what those are wrong by sideways.
  double makeObstacle(const DepthGrid& grid, double simplification) {
    double margin = 1.0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (!(grid.inverse[i] > 0.0)) continue;
      const double depth = 1.0 / grid.inverse[i];
      margin = std::max(margin, 1.0 + 2.0 * sensor_(depth, 0.0).lateral / (grid.pitch * depth));
    }
    const bool occupied = request_.unseen == UnseenSpace::occupied;
    const int pixels = static_cast<int>(std::ceil(std::min(margin, 20.0)));
    const DepthGrid larger = grown(grid, pixels, occupied);
    GridMesh front = meshOf(larger, simplification, occupied);
    if (occupied) {
      const Eigen::Vector3d eye = cloud_.sensor.translation();
      result_.obstacle = shadowOf(front.mesh, eye, request_.shadow_depth);
      result_.obstacle_is_solid = true;
      note("unseen space is occupied: the shadow up to " + numberText(request_.shadow_depth) +
           " m behind the surface, and holes in it, belong to the obstacle");
    } else {
      result_.obstacle = std::move(front.mesh);
      if (request_.unseen == UnseenSpace::report) {
        note(
            "unseen space is left free, which is not known: what is behind the surface is not in "
            "the obstacle");
      }
    }
    return front.deviation;
  }

  void addRegions(const DepthGrid& grid, const std::vector<double>& bands,
                  const std::vector<std::size_t>& sizes) {
    result_.regions.resize(sizes.size());
    for (int i = 0; i < static_cast<int>(grid.size()); ++i) {
      if (grid.region[i] < 0) continue;
      ReconstructedRegion& region = result_.regions[grid.region[i]];
      ++region.points;
      region.box.extend(grid.point(i));
      if (grid.incidence[i] <= kSteepestCertain) region.band = std::max(region.band, bands[i]);
    }
  }

  void ofPoints() {
    Points points;
    for (std::size_t i = 0; i < keep_.size(); ++i) {
      if (keep_[i]) points.push_back(cloud_.points[i]);
    }
    const std::vector<std::uint8_t> good = inliers(points);
    Points kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (good[i]) kept.push_back(points[i]);
    }
    used_ = kept.size();
    if (kept.size() < std::max<std::size_t>(4, request_.least_points)) return;
    finish("outliers", 0.4);
    PointsMesh mesh = meshOfPoints(kept, cloud_.sensor.translation(), request_.meshing);
    finish("mesh", 0.9);
    if (mesh.mesh.triangles.empty()) return;
    const double factor =
        deviationsFor(request_.coverage, static_cast<double>(used_) / mesh.averaged);
    ReconstructedRegion region;
    region.points = used_;
    const Eigen::Isometry3d to_sensor = cloud_.sensor.inverse();
    for (std::size_t i = 0; i < mesh.mesh.vertices.size(); ++i) {
      const Eigen::Vector3d at = to_sensor * mesh.mesh.vertices[i];
      const double angle = std::min(mesh.incidence[i], kSteepestCertain);
      const PointNoise noise = sensor_(std::fabs(at.z()), angle);
      const double across =
          std::hypot(noise.axial * std::cos(angle), noise.lateral * std::sin(angle));
      region.band = std::max(region.band, factor * across / std::sqrt(mesh.averaged));
      region.box.extend(mesh.mesh.vertices[i]);
    }
    // The neighbours of a point are about this far from it: what bends within that is lost.
    const double between = kBetweenPixels * mesh.spacing * std::sqrt(mesh.averaged);
    result_.band = Band::within(region.band + between);
    result_.regions = {region};
    result_.surface = welded(mesh.mesh);
    result_.obstacle = result_.surface;
    if (request_.unseen == UnseenSpace::occupied) {
      result_.obstacle =
          shadowOf(result_.surface, cloud_.sensor.translation(), request_.shadow_depth);
      note(
          "the shadow of a cloud that is no image need not be closed: contact of surfaces is "
          "asked");
    }
    note(std::string("meshed by ") +
         (request_.meshing == PointMeshing::greedy ? "greedy projection"
                                                   : "Poisson, trimmed to the points") +
         ", every point averaged with " + numberText(std::round(mesh.averaged - 1.0)) + " others");
  }

  void shareErrors() {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : result_.surface.vertices) box.extend(vertex);
    result_.reference = box.center();
    result_.pose_covariance =
        carriedTo(result_.reference, cloud_.sensor.translation(), request_.sensor_pose_covariance);
    result_.covariance = result_.pose_covariance.topLeftCorner<3, 3>();
  }

  const PointCloud& cloud_;
  const ReconstructionRequest& request_;
  SensorModel sensor_;
  std::vector<std::uint8_t> keep_;
  std::size_t finite_ = 0;
  std::size_t used_ = 0;
  Reconstruction result_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace
}  // namespace detail

Reconstruction reconstruct(const PointCloud& cloud, const ReconstructionRequest& request) {
  return detail::Reconstructor(cloud, request).run();
}

Eigen::Matrix<double, 6, 6> carriedTo(const Eigen::Vector3d& x, const Eigen::Vector3d& o,
                                      const Eigen::Matrix<double, 6, 6>& covariance) {
  Eigen::Matrix<double, 6, 6> adjoint = Eigen::Matrix<double, 6, 6>::Identity();
  adjoint.topRightCorner<3, 3>() = -detail::crossMatrix(x - o);
  return adjoint * covariance * adjoint.transpose();
}

}  // namespace fcl_prob
