// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Point clouds: files good and bad, sensor models, meshes and bands of surfaces that are known.
#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <random>

#include "catch.h"
#include "cloud/cloud_files.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/reconstruction.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh_visitor.h"

using namespace fcl_prob;
using fcl_prob::detail::decompressLzf;
using fcl_prob::detail::readCloud;

namespace {

const std::string kHeader =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT "
    "1\n"
    "VIEWPOINT 0 0 1 1 0 0 0\nPOINTS 3\nDATA ";

std::string bytesOf(const std::vector<float>& numbers) {
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::string countOf(std::size_t number) {
  const auto narrow = static_cast<std::uint32_t>(number);
  std::string bytes(sizeof narrow, '\0');
  std::memcpy(bytes.data(), &narrow, sizeof narrow);
  return bytes;
}

PointCloud read(const std::string& content, const std::string& name = "cloud.pcd") {
  return readCloud(name, content, {});
}

/// A depth image of a ball 1 m ahead, with axial noise.
PointCloud imageOfBall(double radius, double sigma, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  PointCloud cloud;
  cloud.width = 200;
  cloud.height = 160;
  for (int v = 0; v < 160; ++v) {
    for (int u = 0; u < 200; ++u) {
      const Eigen::Vector3d ray((u - 99.5) / 400.0, (v - 79.5) / 400.0, 1.0);
      const double a = ray.squaredNorm(), b = ray.z(), c = 1.0 - radius * radius;
      const double under_root = b * b - a * c;
      if (under_root < 0.0) {
        cloud.points.push_back(Eigen::Vector3d::Constant(std::nan("")));
        continue;
      }
      const double depth = (b - std::sqrt(under_root)) / a + sigma * normal(engine);
      cloud.points.push_back(depth * ray);
    }
  }
  return cloud;
}

ReconstructionRequest withAxialNoise(double sigma) {
  ReconstructionRequest request;
  request.sensor = [sigma](double, double) { return PointNoise{sigma, 0.0}; };
  return request;
}

}  // namespace

TEST_CASE("clouds are read from every kind of PCD and from PLY", "[cloud]") {
  const std::vector<float> numbers{1, 2, 3, NAN, 5, 6, 7, 8, 9.5};
  const std::vector<float> by_field{1, NAN, 7, 2, 5, 8, 3, 6, 9.5};
  std::string compressed(1, static_cast<char>(31));
  compressed += bytesOf(by_field).substr(0, 32);
  compressed += static_cast<char>(3);
  compressed += bytesOf(by_field).substr(32);
  const std::vector<std::string> files{
      kHeader + "ascii\n1 2 3\nnan 5 6\n7 8 9.5\n", kHeader + "binary\n" + bytesOf(numbers),
      kHeader + "binary_compressed\n" + countOf(compressed.size()) + countOf(36) + compressed};
  for (const std::string& file : files) {
    const PointCloud cloud = read(file);
    REQUIRE(cloud.points.size() == 3);
    CHECK(cloud.points[0] == Eigen::Vector3d(1, 2, 3));
    CHECK_FALSE(cloud.points[1].allFinite());
    CHECK(cloud.points[2] == Eigen::Vector3d(7, 8, 9.5));
    CHECK(cloud.sensor.translation() == Eigen::Vector3d(0, 0, 1));
    for (std::size_t cut = 0; cut + 8 < file.size(); cut += 7) {
      CHECK_THROWS_AS(read(file.substr(0, cut)), Exception);
    }
  }
  const PointCloud ply = read(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n1 2 3\n4 5 6\n",
      "cloud.ply");
  CHECK(ply.points[1] == Eigen::Vector3d(4, 5, 6));
}

TEST_CASE("clouds that promise too much are refused before memory is asked for", "[cloud]") {
  const auto promise = [](const std::string& width, const std::string& data) {
    std::string header = kHeader;
    header.replace(header.find("WIDTH 3"), 7, "WIDTH " + width);
    header.replace(header.find("POINTS 3"), 8, "POINTS " + width);
    return header + data;
  };
  for (const char* data : {"ascii\n1 2 3\n", "binary\n123", "binary_compressed\n12345678"}) {
    for (const char* width : {"4000000000", "30000000", "-1", "x", "99999999999999999999", "0"}) {
      CHECK_THROWS_AS(read(promise(width, data)), FileError);
    }
  }
  CHECK_THROWS_AS(read("", "cloud.pcd"), FileError);
  CHECK_THROWS_AS(read("x", "cloud.xyz"), FileError);
  CHECK_THROWS_AS(read(kHeader + "ascii\nnan nan nan\nnan 1 1\n1 nan 1\n"), InvalidGeometry);
  CHECK_FALSE(decompressLzf("\x20\x00", 3));           // refers to what is not there
  CHECK_FALSE(decompressLzf("\x01\x41", 2));           // ends early
  CHECK_FALSE(decompressLzf("\x00\x41", 1000000000));  // cannot give so much
  CHECK(decompressLzf(std::string("\x00\x41\x20\x00", 4), 4) == "AAAA");
}

TEST_CASE("sensor models are those of their papers", "[cloud]") {
  const PointNoise kinect = nguyenKinect(585.0)(2.0, 0.0);
  CHECK(kinect.axial == Catch::Detail::Approx(0.0012 + 0.0019 * 1.6 * 1.6));
  CHECK(kinect.lateral == Catch::Detail::Approx(0.8 * 2.0 / 585.0));
  const double steep = 70.0 * M_PI / 180.0;
  const double left = M_PI / 2 - steep;
  CHECK(nguyenKinect(585.0)(1.0, steep).axial ==
        Catch::Detail::Approx(0.0012 + 0.0019 * 0.36 + 0.0001 * steep * steep / (left * left)));
  // The paper's Section 4: a few millimetres at half a metre, 4 cm at five.
  CHECK(khoshelhamKinect(585.0)(5.0, 0.0).axial == Catch::Detail::Approx(0.0356).epsilon(0.01));
  CHECK(stereoSensor(500.0, 0.1, 0.5)(2.0, 0.0).axial == Catch::Detail::Approx(0.04));
  CHECK_THROWS_AS(nguyenKinect(0.0), InvalidRequest);
  CHECK_THROWS_AS(sensorModelFromString("eye", 500.0), InvalidRequest);
}

TEST_CASE("a pose covariance is carried to a point by the lever", "[cloud]") {
  Eigen::Matrix<double, 6, 1> sigma;
  sigma << 0.001, 0.002, 0.003, 0.004, 0.005, 0.006;
  const Eigen::Matrix<double, 6, 6> covariance = sigma.cwiseAbs2().asDiagonal();
  const Eigen::Vector3d o(0.1, 0.2, 0.3), x(0.4, -0.2, 2.0);
  const auto carried = carriedTo(x, o, covariance);
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    Eigen::Vector3d t, r;
    for (int k = 0; k < 3; ++k) {
      t[k] = sigma[k] * normal(engine);
      r[k] = sigma[3 + k] * normal(engine);
    }
    const Eigen::Vector3d moved = Eigen::AngleAxisd(r.norm(), r.normalized()) * (x - o) + o + t - x;
    sampled += moved * moved.transpose() / kSamples;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double scale = std::sqrt(carried(i, i) * carried(j, j));
      CHECK(std::fabs(sampled(i, j) - carried(i, j)) < 0.02 * scale);
    }
  }
}

TEST_CASE("the mesh of a depth image is within its band of the ball that was seen", "[cloud]") {
  for (const double sigma : {0.0, 0.001, 0.003}) {
    const double radius = 0.15;
    const Reconstruction result = reconstruct(imageOfBall(radius, sigma, 5), withAxialNoise(sigma));
    CAPTURE(sigma, result.band.inward, result.deviation);
    REQUIRE(result.surface.triangles.size() > 50);
    CHECK(result.deviation <= 0.0010001);
    CHECK(result.band.inward < 0.004 + 4 * sigma);
    double farthest = 0.0;
    for (const auto& t : result.surface.triangles) {
      const Eigen::Vector3d middle =
          (result.surface.vertices[t[0]] + result.surface.vertices[t[1]] +
           result.surface.vertices[t[2]]) /
          3.0;
      farthest = std::max(farthest, std::fabs((middle - Eigen::Vector3d(0, 0, 1)).norm() - radius));
    }
    CHECK(farthest <= result.band.inward);
    CHECK(result.regions.size() == 1);
    CHECK(result.share_used > 0.95);
    CHECK(result.largest_hole == 0.0);
  }
}

TEST_CASE("the shadow of a surface is a closed solid behind it", "[cloud]") {
  ReconstructionRequest request = withAxialNoise(0.0005);
  request.unseen = UnseenSpace::occupied;
  PointCloud cloud = imageOfBall(0.15, 0.0005, 9);
  // A hole in it.
  for (int v = 70; v < 85; ++v) {
    for (int u = 90; u < 110; ++u) cloud.points[200 * v + u].setConstant(std::nan(""));
  }
  const Reconstruction result = reconstruct(cloud, request);
  CHECK(result.largest_hole > 0.03);
  CHECK(result.largest_hole < 0.08);
  REQUIRE(result.obstacle_is_solid);
  const auto model = buildModel<fcl::OBBRSSd>(result.obstacle);
  const detail::ClosedMesh solid(detail::meshView(*model), "shadow");
  CHECK(solid.contains(Eigen::Vector3d(0, 0, 1.0), 0.0) == detail::Containment::inside);
  CHECK(solid.contains(Eigen::Vector3d(0, 0, 0.8), 0.0) == detail::Containment::outside);
  // Behind the hole, which is no way through.
  CHECK(solid.contains(Eigen::Vector3d(0.0, -0.01, 0.9), 0.0) == detail::Containment::inside);
}

TEST_CASE("clouds that are no image are meshed by PCL", "[cloud]") {
  PointCloud image = imageOfBall(0.15, 0.0, 1), cloud;
  for (std::size_t i = 0; i < image.points.size(); i += 7) {
    if (image.points[i].allFinite()) cloud.points.push_back(image.points[i]);
  }
  cloud.width = cloud.points.size();
  for (const PointMeshing meshing : {PointMeshing::greedy, PointMeshing::poisson}) {
    ReconstructionRequest request = withAxialNoise(0.0005);
    request.meshing = meshing;
    const Reconstruction result = reconstruct(cloud, request);
    REQUIRE(result.surface.triangles.size() > 100);
    for (const Eigen::Vector3d& vertex : result.surface.vertices) {
      const double off = std::fabs((vertex - Eigen::Vector3d(0, 0, 1)).norm() - 0.15);
      CHECK(off <= result.band.inward);
    }
  }
}

TEST_CASE("too little of a cloud, and bad requests, are refused", "[cloud]") {
  const PointCloud ball = imageOfBall(0.15, 0.0, 1);
  ReconstructionRequest request = withAxialNoise(0.001);
  request.crop = Eigen::AlignedBox3d(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6));
  CHECK_THROWS_AS(reconstruct(ball, request), InvalidGeometry);
  request.crop.reset();
  request.least_points = 1000000;
  CHECK_THROWS_AS(reconstruct(ball, request), InvalidGeometry);
  request.least_points = 50;
  request.window = -1;
  CHECK_THROWS_AS(reconstruct(ball, request), InvalidRequest);
  request.window = 2;
  request.on_progress = [](double) { return false; };
  CHECK_THROWS_AS(reconstruct(ball, request), InvalidRequest);
  PointCloud turned = ball;
  turned.sensor.translate(Eigen::Vector3d(3, 0, 1.2));
  CHECK_THROWS_AS(reconstruct(turned, withAxialNoise(0.001)), InvalidGeometry);
}
