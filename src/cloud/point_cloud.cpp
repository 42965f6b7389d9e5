// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/point_cloud.h"

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>

#include "cloud/cloud_files.h"
#include "fcl_prob/exceptions.h"
#include "io/file_content.h"
#include "io/ply_reader.h"

namespace fcl_prob {
namespace detail {
namespace {

// The vertices must come first, as in every file that we have seen.
const PlyElement& vertexElement(const std::string& path, const PlyHeader& header) {
  if (header.elements.empty() || header.elements[0].name != "vertex") {
    throw FileError(path + ": the first element of the PLY file is not vertex");
  }
  return header.elements[0];
}

}  // namespace

PointCloud readPly(const std::string& path, std::string_view content, const CloudLimits& limits) {
  const PlyHeader header = readPlyHeader(path, content);
  const PlyElement& vertices = vertexElement(path, header);
  std::array<bool, 3> found{};
  for (const PlyProperty& property : vertices.properties) {
    if (property.length_type) throw FileError(path + ": a vertex has a list");
    for (std::size_t k = 0; k < 3; ++k)
      found[k] = found[k] || property.name == std::string(1, "xyz"[k]);
  }
  if (!found[0] || !found[1] || !found[2]) throw FileError(path + ": a vertex has no x, y and z");
  const std::string_view body = content.substr(header.body);
  // No number takes less than a byte.
  if (vertices.count > limits.points || vertices.count > body.size() / vertices.properties.size()) {
    throw FileError(path + ": the header promises " + std::to_string(vertices.count) +
                    " points, more than the file has or may have");
  }
  PointCloud cloud;
  cloud.width = vertices.count;
  cloud.points.reserve(vertices.count);
  PlyBodyReader reader(body, header.encoding);
  for (std::size_t i = 0; i < vertices.count; ++i) {
    Eigen::Vector3d point;
    for (const PlyProperty& property : vertices.properties) {
      const std::optional<double> number = reader.next(property.type);
      if (!number) {
        throw FileError(path + ": point " + std::to_string(i + 1) +
                        ": the data end or are not numbers");
      }
      const std::size_t axis = std::string("xyz").find(property.name);
      if (property.name.size() == 1 && axis < 3) point[static_cast<int>(axis)] = *number;
    }
    cloud.points.push_back(point);
  }
  return cloud;
}

PointCloud readCloud(const std::string& path, std::string_view content, const CloudLimits& limits) {
  const std::string extension =
      boost::algorithm::to_lower_copy(std::filesystem::path(path).extension().string());
  if (extension != ".pcd" && extension != ".ply") {
    throw FileError(path + ": unknown kind of point cloud '" + extension +
                    "'; known are .pcd .ply");
  }
  if (content.empty()) throw FileError(path + ": the file is empty");
  PointCloud cloud =
      extension == ".pcd" ? readPcd(path, content, limits) : readPly(path, content, limits);
  // Beyond this squares overflow.
  constexpr double kFarthest = 1e100;
  bool any = false;
  for (Eigen::Vector3d& point : cloud.points) {
    const bool finite = point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthest;
    if (!finite) point.setConstant(std::numeric_limits<double>::quiet_NaN());
    any = any || finite;
  }
  if (!any)
    throw InvalidGeometry(path + ": none of " + std::to_string(cloud.points.size()) +
                          " points is finite");
  return cloud;
}

}  // namespace detail

PointCloud loadPointCloud(const std::string& path, const CloudLimits& limits) {
  return detail::readCloud(path, detail::fileContent(path, limits.file_bytes), limits);
}

}  // namespace fcl_prob
