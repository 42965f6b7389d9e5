// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/depth_image.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>

namespace fcl_prob::cli {
namespace {

// So many samples a pixel along each axis: what a ray off by a part of a pixel sees.
constexpr int kOversampling = 4;

double normalVariable(Uniforms& random) {
  return std::sqrt(2.0) * boost::math::erf_inv(2.0 * random.next() - 1.0);
}

/// Nearest triangle of every sample.
class DepthBuffer {
 public:
  DepthBuffer(const TriangleMesh& mesh, const DepthCamera& camera)
      : mesh_(mesh),
        width_(camera.width * kOversampling),
        height_(camera.height * kOversampling),
        focal_(camera.focal_length * kOversampling) {
    const auto samples = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    depth_.assign(samples, std::numeric_limits<float>::infinity());
    triangle_.assign(samples, -1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) draw(static_cast<int>(t));
  }

  struct Sample {
    double depth;
    double incidence;
  };

  /// \param x, y  in pixels of the image; depth infinite where nothing is
  Sample at(double x, double y) const {
    const int u = static_cast<int>(std::floor(x * kOversampling));
    const int v = static_cast<int>(std::floor(y * kOversampling));
    if (u < 0 || v < 0 || u >= width_ || v >= height_) return {kNothing, 0.0};
    const std::size_t i = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(u);
    if (triangle_[i] < 0) return {kNothing, 0.0};
    const Eigen::Vector3d ray((u + 0.5 - 0.5 * width_) / focal_, (v + 0.5 - 0.5 * height_) / focal_,
                              1.0);
    const double cosine = std::fabs(normalOf(triangle_[i]).dot(ray.normalized()));
    return {static_cast<double>(depth_[i]), std::acos(std::min(cosine, 1.0))};
  }

 private:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  const Eigen::Vector3d& corner(int triangle, int k) const {
    return mesh_.vertices[mesh_.triangles[static_cast<std::size_t>(triangle)][k]];
  }

  Eigen::Vector3d normalOf(int t) const {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).normalized();
  }

  // Inverse depth is linear over the image.
  void draw(int t) {
    Eigen::Vector3d x, y, inverse;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = corner(t, k);
      if (!(p.z() > 1e-3)) return;
      x[k] = focal_ * p.x() / p.z() + 0.5 * width_ - 0.5;
      y[k] = focal_ * p.y() / p.z() + 0.5 * height_ - 0.5;
      inverse[k] = 1.0 / p.z();
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0.0) return;
    const auto from = [](double lowest) {
      return std::max(0, static_cast<int>(std::ceil(lowest)));
    };
    const auto to = [](double highest, int size) {
      return std::min(size - 1, static_cast<int>(std::floor(highest)));
    };
    for (int v = from(y.minCoeff()); v <= to(y.maxCoeff(), height_); ++v) {
      for (int u = from(x.minCoeff()); u <= to(x.maxCoeff(), width_); ++u) {
        const double b = ((u - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (v - y[0])) / area;
        const double c = ((x[1] - x[0]) * (v - y[0]) - (u - x[0]) * (y[1] - y[0])) / area;
        if (b < 0.0 || c < 0.0 || b + c > 1.0) continue;
        const double depth = 1.0 / ((1.0 - b - c) * inverse[0] + b * inverse[1] + c * inverse[2]);
        const std::size_t i = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(u);
        if (!(depth < depth_[i])) continue;
        depth_[i] = static_cast<float>(depth);
        triangle_[i] = t;
      }
    }
  }

  const TriangleMesh& mesh_;
  int width_;
  int height_;
  double focal_;
  std::vector<float> depth_;
  std::vector<int> triangle_;
};

}  // namespace

PointCloud renderedCloud(const TriangleMesh& mesh, const DepthCamera& camera,
                         const SensorModel& sensor, Uniforms& random) {
  const DepthBuffer buffer(mesh, camera);
  PointCloud cloud;
  cloud.width = static_cast<std::size_t>(camera.width);
  cloud.height = static_cast<std::size_t>(camera.height);
  cloud.points.assign(cloud.width * cloud.height,
                      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  std::size_t i = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u, ++i) {
      double depth = buffer.at(u + 0.5, v + 0.5).depth;
      // What is seen just beside nothing may be met by a ray that is off.
      if (!std::isfinite(depth)) depth = buffer.at(u + 2.5, v + 0.5).depth;
      if (!std::isfinite(depth)) depth = buffer.at(u - 1.5, v + 0.5).depth;
      if (!std::isfinite(depth)) continue;
      const double lateral = sensor(depth, 0.0).lateral * camera.focal_length / depth;
      const auto seen = buffer.at(u + 0.5 + lateral * normalVariable(random),
                                  v + 0.5 + lateral * normalVariable(random));
      if (!std::isfinite(seen.depth)) continue;
      const double axial = sensor(seen.depth, seen.incidence).axial;
      const double noisy = seen.depth + axial * normalVariable(random);
      if (!(noisy > 0.0)) continue;
      cloud.points[i] =
          noisy * Eigen::Vector3d((u + 0.5 - 0.5 * camera.width) / camera.focal_length,
                                  (v + 0.5 - 0.5 * camera.height) / camera.focal_length, 1.0);
    }
  }
  return cloud;
}

}  // namespace fcl_prob::cli
