// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A scene with all that is in it, as one JSON document.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/scene_io.h"
#include "io/quantities.h"
#include "io/scene_parts.h"

namespace fcl_prob {
namespace {

// Doubles are written such that they are read back to the last bit.
using Json = nlohmann::ordered_json;

Json listOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// The upper triangle, row by row.
template <class Matrix>
Json triangleOf(const Matrix& covariance) {
  Json list = Json::array();
  for (int i = 0; i < covariance.rows(); ++i) {
    for (int j = i; j < covariance.cols(); ++j) list.push_back(covariance(i, j));
  }
  return list;
}

template <class Shape>
Json roundOf(const fcl::CollisionGeometryd& geometry) {
  const auto& shape = static_cast<const Shape&>(geometry);
  return {{"radius", shape.radius}, {"length", shape.lz}};
}

template <class Shape>
Json flatOf(const fcl::CollisionGeometryd& geometry) {
  const auto& shape = static_cast<const Shape&>(geometry);
  return {{"normal", listOf(shape.n)}, {"offset", shape.d}};
}

Json primitiveOf(const fcl::CollisionGeometryd& geometry) {
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
      return {{"box", listOf(static_cast<const fcl::Boxd&>(geometry).side)}};
    case fcl::GEOM_SPHERE:
      return {{"sphere", static_cast<const fcl::Sphered&>(geometry).radius}};
    case fcl::GEOM_ELLIPSOID:
      return {{"ellipsoid", listOf(static_cast<const fcl::Ellipsoidd&>(geometry).radii)}};
    case fcl::GEOM_CAPSULE:
      return {{"capsule", roundOf<fcl::Capsuled>(geometry)}};
    case fcl::GEOM_CONE:
      return {{"cone", roundOf<fcl::Coned>(geometry)}};
    case fcl::GEOM_CYLINDER:
      return {{"cylinder", roundOf<fcl::Cylinderd>(geometry)}};
    case fcl::GEOM_HALFSPACE:
      return {{"halfspace", flatOf<fcl::Halfspaced>(geometry)}};
    case fcl::GEOM_PLANE:
      return {{"plane", flatOf<fcl::Planed>(geometry)}};
    default:
      throw UnsupportedGeometry("a scene with an occupancy map cannot be written into one file");
  }
}

Json objectOf(const SceneObject& object) {
  if (object.possible) {
    throw UnsupportedGeometry("a scene with a reconstructed cloud cannot be written into one file");
  }
  Json json;
  if (const auto* mesh = std::get_if<MeshFile>(&object.shape)) {
    json["mesh"] = detail::meshJson(mesh->read());
  } else {
    json = primitiveOf(*std::get<PrimitiveShape>(object.shape));
  }
  Json pose = Json::array();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.push_back(object.pose.linear()(i, j));
    pose.push_back(object.pose.translation()[i]);
  }
  json["pose"] = std::move(pose);
  if (object.band.outward != 0.0 || object.band.inward != 0.0) {
    json["band"] = {object.band.outward, object.band.inward};
  }
  return json;
}

}  // namespace

namespace detail {

Json meshJson(const TriangleMesh& mesh) {
  Json vertices = Json::array(), triangles = Json::array();
  for (const fcl::Vector3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) vertices.push_back(v[k]);
  }
  for (const fcl::Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) triangles.push_back(t[k]);
  }
  return {{"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}};
}

Json requestJson(const ProbabilityRequest& request) {
  Json json{{"method", toString(request.method)},
            {"contact", toString(request.contact)},
            {"relative_tolerance", request.relative_tolerance},
            {"absolute_tolerance", request.absolute_tolerance},
            {"confidence", request.confidence},
            {"samples", request.samples},
            {"max_cells", request.max_cells},
            {"max_memory", request.max_memory},
            {"seed", request.seed}};
  if (request.threshold) json["threshold"] = *request.threshold;
  if (request.time_limit) json["time_limit"] = *request.time_limit;
  return json;
}

}  // namespace detail

void writeScene(const Scene& scene, const std::string& description, std::ostream& out) {
  Json json{{"description", description}, {"a", objectOf(scene.a)}, {"b", objectOf(scene.b)}};
  if (scene.pose_error) {
    const PoseError::Vector6& mean = scene.pose_error->mean();
    json["pose_error"] = {{"covariance", triangleOf(scene.pose_error->covariance())},
                          {"mean", std::vector<double>(mean.data(), mean.data() + 6)},
                          {"convention", detail::toString(scene.pose_error->convention())}};
  } else {
    json["displacement"] = {{"covariance", triangleOf(scene.displacement.covariance())},
                            {"mean", listOf(scene.displacement.mean())}};
  }
  json["request"] = detail::requestJson(scene.request);
  out << json.dump() << '\n';
}

}  // namespace fcl_prob
