// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cloud/depth_grid.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "cloud/median.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

// Neighbours farther apart in depth than so many times their distance across are no surface: seen
// at less than 11°; nor are those beyond so many deviations of the noise.
constexpr double kSteepest = 5.0;
constexpr double kNoiseJump = 5.0;

constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// The pixels that are kept, with room around them for a surface to grow.
struct Window {
  int lo_u;
  int lo_v;
  int hi_u;
  int hi_v;
};

Window windowOf(const PointCloud& cloud, const std::vector<std::uint8_t>& keep) {
  constexpr int kRoom = 24;
  const int width = static_cast<int>(cloud.width), height = static_cast<int>(cloud.height);
  Window window{width - 1, height - 1, 0, 0};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!keep[static_cast<std::size_t>(v) * cloud.width + static_cast<std::size_t>(u)]) continue;
      window = {std::min(window.lo_u, u), std::min(window.lo_v, v), std::max(window.hi_u, u),
                std::max(window.hi_v, v)};
    }
  }
  return {std::max(window.lo_u - kRoom, 0), std::max(window.lo_v - kRoom, 0),
          std::min(window.hi_u + kRoom, width - 1), std::min(window.hi_v + kRoom, height - 1)};
}

// Of an image the rays turn the same way from pixel to pixel.
void requireImage(const DepthGrid& grid) {
  std::size_t right = 0, left = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u + 1 < grid.width; ++u) {
      if (!grid.has(u, v) || !grid.has(u + 1, v)) continue;
      const double turn = grid.rays[grid.at(u + 1, v)].x() - grid.rays[grid.at(u, v)].x();
      ++(turn > 0.0 ? right : left);
    }
  }
  const std::size_t all = right + left;
  if (all > 0 && 20 * std::min(right, left) > all) {
    throw InvalidGeometry(
        "an organised cloud whose points do not lie on rays from its viewpoint: where was the "
        "sensor?");
  }
}

double pitchOf(const DepthGrid& grid) {
  std::vector<double> steps;
  for (int v = 0; v < grid.height; v += 3) {
    for (int u = 0; u + 1 < grid.width; u += 3) {
      if (!grid.has(u, v) || !grid.has(u + 1, v)) continue;
      steps.push_back((grid.rays[grid.at(u + 1, v)] - grid.rays[grid.at(u, v)]).norm());
    }
  }
  return median(std::move(steps));
}

// Calls function(neighbour pixel) for the four neighbours that belong to the image.
template <typename Function>
void visitNeighbours(const DepthGrid& grid, int pixel, const Function& function) {
  const int u = pixel % grid.width, v = pixel / grid.width;
  for (const auto& [du, dv] : kNeighbours) {
    if (u + du < 0 || v + dv < 0 || u + du >= grid.width || v + dv >= grid.height) continue;
    function(grid.at(u + du, v + dv));
  }
}

/// All pixels that steps from `start` lead to, none of which was `seen` before.
/// \param leads  whether a step from a pixel to its neighbour is one
template <typename Leads>
std::vector<int> reachedFrom(const DepthGrid& grid, int start, const Leads& leads,
                             std::vector<std::uint8_t>& seen) {
  std::vector<int> reached{start};
  seen[start] = 1;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    visitNeighbours(grid, reached[next], [&, pixel = reached[next]](int other) {
      if (seen[other] || !leads(pixel, other)) return;
      seen[other] = 1;
      reached.push_back(other);
    });
  }
  return reached;
}

}  // namespace

bool DepthGrid::connected(int p, int q, int apart) const {
  if (!(inverse[p] > 0.0) || !(inverse[q] > 0.0)) return false;
  const double near = 1.0 / std::max(inverse[p], inverse[q]);
  const double far = 1.0 / std::min(inverse[p], inverse[q]);
  const double noise = kNoiseJump * std::max(deviation[p], deviation[q]);
  return far - near <= std::max(kSteepest * apart * pitch * far, noise);
}

DepthGrid depthGrid(const PointCloud& cloud, const std::vector<std::uint8_t>& keep) {
  DepthGrid grid;
  const Window window = windowOf(cloud, keep);
  grid.width = window.hi_u - window.lo_u + 1;
  grid.height = window.hi_v - window.lo_v + 1;
  grid.sensor = cloud.sensor;
  const auto count = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  grid.rays.assign(count, Eigen::Vector3d::Zero());
  grid.inverse.assign(count, 0.0);
  grid.deviation.assign(count, 0.0);
  grid.incidence.assign(count, 0.0);
  grid.region.assign(count, -1);
  const Eigen::Isometry3d to_sensor = cloud.sensor.inverse();
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const std::size_t of_cloud = static_cast<std::size_t>(v + window.lo_v) * cloud.width +
                                   static_cast<std::size_t>(u + window.lo_u);
      if (!keep[of_cloud]) continue;
      const Eigen::Vector3d q = to_sensor * cloud.points[of_cloud];
      const double depth = std::fabs(q.z());
      if (!(depth > 1e-6 * q.norm())) continue;
      grid.rays[grid.at(u, v)] = q / depth;
      grid.inverse[grid.at(u, v)] = 1.0 / depth;
    }
  }
  requireImage(grid);
  grid.pitch = pitchOf(grid);
  return grid;
}

void judgeNoise(const SensorModel& sensor, DepthGrid& grid) {
  // A first look without slopes, by which pixels are told to be on one surface.
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.inverse[i] > 0.0) grid.deviation[i] = sensor(1.0 / grid.inverse[i], 0.0).axial;
  }
  DepthGrid smooth = grid;
  average(2, smooth);
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const int pixel = grid.at(u, v);
      if (!grid.has(u, v)) continue;
      Eigen::Vector3d along[2];
      for (int axis = 0; axis < 2; ++axis) {
        const int du = axis == 0 ? 1 : 0, dv = 1 - du;
        int from = pixel, to = pixel;
        if (grid.has(u - du, v - dv) && smooth.connected(grid.at(u - du, v - dv), pixel)) {
          from = grid.at(u - du, v - dv);
        }
        if (grid.has(u + du, v + dv) && smooth.connected(grid.at(u + du, v + dv), pixel)) {
          to = grid.at(u + du, v + dv);
        }
        along[axis] =
            smooth.rays[to] / smooth.inverse[to] - smooth.rays[from] / smooth.inverse[from];
      }
      const Eigen::Vector3d normal = along[0].cross(along[1]);
      const double cosine = normal.norm() > 0.0 ? std::fabs(normal.dot(smooth.rays[pixel])) /
                                                      (normal.norm() * smooth.rays[pixel].norm())
                                                : 1.0;
      const double incidence = std::acos(std::clamp(cosine, 0.0, 1.0));
      const PointNoise noise = sensor(1.0 / grid.inverse[pixel], incidence);
      const double slope = std::min(std::tan(std::min(incidence, 1.45)), kSteepest);
      grid.incidence[pixel] = incidence;
      grid.deviation[pixel] = std::hypot(noise.axial, slope * noise.lateral);
    }
  }
}

double average(int window, DepthGrid& grid) {
  if (window <= 0) return 1.0;
  std::vector<double> inverse(grid.size(), 0.0), deviation(grid.size(), 0.0);
  double averaged = 0.0;
  std::size_t pixels = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const int pixel = grid.at(u, v);
      if (!grid.has(u, v)) continue;
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      int count = 0;
      for (int dv = -window; dv <= window; ++dv) {
        for (int du = -window; du <= window; ++du) {
          if (!grid.has(u + du, v + dv)) continue;
          const int other = grid.at(u + du, v + dv);
          if (!grid.connected(pixel, other, std::max(std::abs(du), std::abs(dv)))) continue;
          const Eigen::Vector3d basis(1.0, du, dv);
          normal += basis * basis.transpose();
          right += basis * grid.inverse[other];
          ++count;
        }
      }
      inverse[pixel] = grid.inverse[pixel];
      deviation[pixel] = grid.deviation[pixel];
      ++pixels;
      averaged += count;
      // In a line, or nearly so, there is no plane through them.
      if (count < 6 || normal.determinant() < 1e-3 * count) continue;
      const Eigen::Matrix3d solved = normal.inverse();
      const double value = solved.row(0).dot(right);
      if (!(value > 0.0)) continue;
      inverse[pixel] = value;
      deviation[pixel] = grid.deviation[pixel] * std::sqrt(std::min(1.0, solved(0, 0)));
    }
  }
  grid.inverse.swap(inverse);
  grid.deviation.swap(deviation);
  return pixels == 0 ? 1.0 : averaged / static_cast<double>(pixels);
}

std::vector<std::size_t> findRegions(std::size_t least, DepthGrid& grid) {
  std::vector<std::size_t> sizes;
  std::vector<std::uint8_t> seen(grid.size(), 0);
  const auto leads = [&grid](int pixel, int other) { return grid.connected(pixel, other); };
  grid.region.assign(grid.size(), -1);
  for (int start = 0; start < static_cast<int>(grid.size()); ++start) {
    if (seen[start] || !(grid.inverse[start] > 0.0)) continue;
    const std::vector<int> members = reachedFrom(grid, start, leads, seen);
    const bool kept = members.size() >= least;
    for (const int pixel : members) {
      if (kept) {
        grid.region[pixel] = static_cast<int>(sizes.size());
      } else {
        grid.inverse[pixel] = 0.0;
      }
    }
    if (kept) sizes.push_back(members.size());
  }
  return sizes;
}

namespace {

/// Connected pixels without depth that do not reach the border.
std::vector<std::vector<int>> holesOf(const DepthGrid& grid) {
  std::vector<std::vector<int>> holes;
  std::vector<std::uint8_t> seen(grid.size(), 0);
  const auto leads = [&grid](int, int other) { return !(grid.inverse[other] > 0.0); };
  const auto isAtBorder = [&grid](int pixel) {
    const int u = pixel % grid.width, v = pixel / grid.width;
    return u == 0 || v == 0 || u == grid.width - 1 || v == grid.height - 1;
  };
  for (int start = 0; start < static_cast<int>(grid.size()); ++start) {
    if (seen[start] || grid.inverse[start] > 0.0) continue;
    std::vector<int> members = reachedFrom(grid, start, leads, seen);
    if (std::none_of(members.begin(), members.end(), isAtBorder)) {
      holes.push_back(std::move(members));
    }
  }
  return holes;
}

// The least depth around a hole, as an inverse.
double nearestAround(const DepthGrid& grid, const std::vector<int>& hole) {
  double nearest = 0.0;
  for (const int pixel : hole) {
    visitNeighbours(grid, pixel,
                    [&](int other) { nearest = std::max(nearest, grid.inverse[other]); });
  }
  return nearest;
}

// The rays of pixels without depth, by the linear model that fits those of the others.
void fillRays(DepthGrid& grid) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
  for (int pixel = 0; pixel < static_cast<int>(grid.size()); ++pixel) {
    if (!(grid.inverse[pixel] > 0.0)) continue;
    const Eigen::Vector3d basis(1.0, pixel % grid.width, pixel / grid.width);
    normal += basis * basis.transpose();
    right += basis * grid.rays[pixel].transpose();
  }
  const Eigen::Matrix3d model = normal.fullPivLu().solve(right);
  for (int pixel = 0; pixel < static_cast<int>(grid.size()); ++pixel) {
    if (grid.inverse[pixel] > 0.0) continue;
    grid.rays[pixel] =
        model.transpose() * Eigen::Vector3d(1.0, pixel % grid.width, pixel / grid.width);
  }
}

}  // namespace

double largestHole(const DepthGrid& grid) {
  double largest = 0.0;
  for (const std::vector<int>& hole : holesOf(grid)) {
    int lo_u = grid.width, hi_u = 0, lo_v = grid.height, hi_v = 0;
    for (const int pixel : hole) {
      lo_u = std::min(lo_u, pixel % grid.width);
      hi_u = std::max(hi_u, pixel % grid.width);
      lo_v = std::min(lo_v, pixel / grid.width);
      hi_v = std::max(hi_v, pixel / grid.width);
    }
    const double across = std::hypot(hi_u - lo_u + 2, hi_v - lo_v + 2) * grid.pitch;
    const double nearest = nearestAround(grid, hole);
    if (nearest > 0.0) largest = std::max(largest, across / nearest);
  }
  return largest;
}

DepthGrid grown(const DepthGrid& grid, int margin, bool fill) {
  DepthGrid result = grid;
  fillRays(result);
  for (int step = 0; step < margin; ++step) {
    const std::vector<double> before = result.inverse;
    for (int pixel = 0; pixel < static_cast<int>(result.size()); ++pixel) {
      if (before[pixel] > 0.0) continue;
      int nearest = -1;
      visitNeighbours(result, pixel, [&](int other) {
        if (before[other] > 0.0 && (nearest < 0 || before[other] > before[nearest]))
          nearest = other;
      });
      if (nearest < 0) continue;
      result.inverse[pixel] = before[nearest];
      result.deviation[pixel] = result.deviation[nearest];
      result.region[pixel] = result.region[nearest];
    }
  }
  if (!fill) return result;
  for (const std::vector<int>& hole : holesOf(result)) {
    const double nearest = nearestAround(result, hole);
    for (const int pixel : hole) result.inverse[pixel] = nearest;
  }
  return result;
}

}  // namespace fcl_prob::detail
