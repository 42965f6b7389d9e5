// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cloud/points_mesh.h"

#include <pcl/console/print.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/poisson.h>

#include <algorithm>
#include <cmath>

#include "cloud/median.h"

namespace fcl_prob::detail {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using NormalCloud = pcl::PointCloud<pcl::PointNormal>;

// Points that one is averaged with, and that give it a normal.
constexpr int kNeighbours = 20;

/// PCL prints what it finds odd about a cloud.
class Silence {
 public:
  Silence() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~Silence() { pcl::console::setVerbosityLevel(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_ = pcl::console::getVerbosityLevel();
};

// PCL computes in single precision: relative to the middle of the points.
Eigen::Vector3d middleOf(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

Cloud::Ptr cloudOf(const Points& points, const Eigen::Vector3d& middle) {
  auto cloud = std::make_shared<Cloud>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3f p = (point - middle).cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
  }
  return cloud;
}

// Every point moved onto the plane through its neighbours, with that plane's normal.
NormalCloud::Ptr averagedPoints(const Cloud::Ptr& cloud, const Eigen::Vector3f& eye,
                                double& spacing) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  auto result = std::make_shared<NormalCloud>();
  std::vector<double> distances;
  pcl::Indices indices;
  std::vector<float> squares;
  for (const pcl::PointXYZ& point : *cloud) {
    if (tree.nearestKSearch(point, kNeighbours, indices, squares) < 4) continue;
    distances.push_back(std::sqrt(static_cast<double>(squares[1])));
    Eigen::Vector4f plane, centre;
    float curvature = 0.0F;
    if (!pcl::computePointNormal(*cloud, indices, plane, curvature)) continue;
    pcl::compute3DCentroid(*cloud, indices, centre);
    Eigen::Vector3f normal = plane.head<3>();
    const Eigen::Vector3f at = point.getVector3fMap();
    if (normal.dot(eye - at) < 0.0F) normal = -normal;
    pcl::PointNormal averaged;
    averaged.getVector3fMap() = at - normal.dot(at - centre.head<3>()) * normal;
    averaged.getNormalVector3fMap() = normal;
    result->push_back(averaged);
  }
  spacing = median(std::move(distances));
  return result;
}

pcl::PolygonMesh greedyMesh(const NormalCloud::Ptr& points, double spacing) {
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
  greedy.setSearchRadius(6.0 * spacing);
  greedy.setMu(2.5);
  greedy.setMaximumNearestNeighbors(60);
  greedy.setMaximumSurfaceAngle(M_PI / 3);
  greedy.setMinimumAngle(M_PI / 18);
  greedy.setMaximumAngle(2 * M_PI / 3);
  greedy.setNormalConsistency(false);
  greedy.setInputCloud(points);
  pcl::PolygonMesh mesh;
  greedy.reconstruct(mesh);
  return mesh;
}

pcl::PolygonMesh poissonMesh(const NormalCloud::Ptr& points) {
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setDepth(8);
  poisson.setInputCloud(points);
  pcl::PolygonMesh mesh;
  poisson.reconstruct(mesh);
  return mesh;
}

}  // namespace

std::optional<Eigen::Vector4d> largestPlane(const Points& points, double tolerance) {
  const Eigen::Vector3d middle = middleOf(points);
  pcl::SACSegmentation<pcl::PointXYZ> segmentation(false);  // always the same samples
  segmentation.setOptimizeCoefficients(true);
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setMaxIterations(500);
  segmentation.setDistanceThreshold(tolerance);
  segmentation.setInputCloud(cloudOf(points, middle));
  pcl::PointIndices members;
  pcl::ModelCoefficients plane;
  segmentation.segment(members, plane);
  if (members.indices.size() < 3 || plane.values.size() != 4) return std::nullopt;
  const Eigen::Vector3d normal(plane.values[0], plane.values[1], plane.values[2]);
  const double length = normal.norm();
  if (!(length > 0.0)) return std::nullopt;
  const Eigen::Vector3d unit = normal / length;
  Eigen::Vector4d result;
  result << unit, -static_cast<double>(plane.values[3]) / length + unit.dot(middle);
  return result;
}

std::vector<std::uint8_t> inliers(const Points& points) {
  std::vector<std::uint8_t> kept(points.size(), 0);
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> removal;
  removal.setMeanK(kNeighbours);
  removal.setStddevMulThresh(3.0);
  removal.setInputCloud(cloudOf(points, middleOf(points)));
  pcl::Indices indices;
  removal.filter(indices);
  for (const int index : indices) kept[static_cast<std::size_t>(index)] = 1;
  return kept;
}

PointsMesh meshOfPoints(const Points& points, const Eigen::Vector3d& eye, PointMeshing meshing) {
  const Silence silence;
  const Eigen::Vector3d middle = middleOf(points);
  const Eigen::Vector3f near_eye = (eye - middle).cast<float>();
  PointsMesh result;
  result.averaged = kNeighbours;
  const NormalCloud::Ptr averaged =
      averagedPoints(cloudOf(points, middle), near_eye, result.spacing);
  if (averaged->size() < 4 || !(result.spacing > 0.0)) return result;
  const bool greedy = meshing == PointMeshing::greedy;
  const pcl::PolygonMesh polygons =
      greedy ? greedyMesh(averaged, result.spacing) : poissonMesh(averaged);
  Cloud vertices;
  pcl::fromPCLPointCloud2(polygons.cloud, vertices);
  pcl::KdTreeFLANN<pcl::PointNormal> tree;
  tree.setInputCloud(averaged);
  pcl::Indices nearest(1);
  std::vector<float> square(1);
  std::vector<std::uint8_t> supported;
  for (const pcl::PointXYZ& vertex : vertices) {
    pcl::PointNormal point;
    point.getVector3fMap() = vertex.getVector3fMap();
    tree.nearestKSearch(point, 1, nearest, square);
    // Poisson closes what was not seen: what is far from all points goes again.
    supported.push_back(greedy || std::sqrt(square[0]) <= 3.0 * result.spacing);
    const Eigen::Vector3f normal =
        (*averaged)[static_cast<std::size_t>(nearest[0])].getNormalVector3fMap();
    const Eigen::Vector3f ray = vertex.getVector3fMap() - near_eye;
    const float cosine = std::fabs(normal.dot(ray.normalized()));
    result.incidence.push_back(std::acos(static_cast<double>(std::min(cosine, 1.0F))));
    result.mesh.vertices.push_back(middle + vertex.getVector3fMap().cast<double>());
  }
  for (const pcl::Vertices& polygon : polygons.polygons) {
    const auto& v = polygon.vertices;
    if (v.size() != 3) continue;
    if (!supported[v[0]] || !supported[v[1]] || !supported[v[2]]) continue;
    result.mesh.triangles.emplace_back(v[0], v[1], v[2]);
  }
  return result;
}

}  // namespace fcl_prob::detail
