// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/scene_parts.h"

#include "io/primitive_shapes.h"
#include "io/quantities.h"

namespace fcl_prob::detail {
namespace {

/// Runs `convert`, whose exceptions do not know where in the file the value stands.
template <typename Convert>
auto located(const StrictObject& object, const std::string& key, const Convert& convert) {
  try {
    return convert();
  } catch (const Exception& error) {
    object.fail(key, error.what());
  }
}

double scaleOf(StrictObject& object) {
  const double scale = object.number("scale");
  if (!(scale > 0.0)) object.fail("scale", "must be > 0");
  return scale;
}

std::shared_ptr<const TriangleMesh> readGivenMesh(StrictObject object) {
  const std::vector<double> coordinates = object.numbers("vertices");
  const std::vector<std::uint64_t> corners = object.counts("triangles");
  object.finish();
  auto mesh = std::make_shared<TriangleMesh>();
  if (coordinates.size() % 3 != 0) object.fail("vertices", "not three numbers each");
  if (corners.size() % 3 != 0) object.fail("triangles", "not three indices each");
  for (std::size_t i = 0; i < coordinates.size(); i += 3) {
    mesh->vertices.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  }
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    mesh->triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  }
  located(object, "triangles", [&] { validateMesh(*mesh); });
  return mesh;
}

MeshFile readMeshFile(StrictObject& object, const std::filesystem::path& folder) {
  MeshFile mesh;
  if (object.holdsObject("mesh")) {
    mesh.given = readGivenMesh(object.object("mesh"));
    return mesh;
  }
  const std::string name = object.text("mesh");
  if (name.empty()) object.fail("mesh", "must not be empty");
  mesh.path = (folder / name).lexically_normal().string();
  if (object.has("scale")) mesh.options.scale = scaleOf(object);
  if (object.has("normalize")) mesh.options.normalize = object.boolean("normalize");
  return mesh;
}

void addPose(StrictObject& object, SceneObject& result) {
  if (const auto pose = readPose(object, "pose")) result.pose = *pose;
}

// A map or a reconstructed cloud, which come with bands of their own.
SceneObject readMeasured(StrictObject& object, const std::filesystem::path& folder) {
  if (object.has("cloud")) {
    return cloudObject((folder / object.text("cloud")).lexically_normal().string());
  }
  const std::string path = (folder / object.text("octomap")).lexically_normal().string();
  const std::string unknown = object.has("unknown") ? object.text("unknown") : "free";
  if (unknown != "free" && unknown != "occupied") {
    object.fail("unknown", "neither free nor occupied");
  }
  return octomapObject(path, unknown == "occupied");
}

}  // namespace

std::optional<fcl::Transform3d> readPose(StrictObject& object, const std::string& key) {
  if (!object.has(key)) return std::nullopt;
  const std::vector<double> numbers = object.numbers(key);
  return located(object, key, [&] { return poseFrom(numbers); });
}

SceneObject readShapeAndPose(StrictObject& object, const std::filesystem::path& folder) {
  SceneObject result;
  std::vector<std::string> kinds = primitiveNames();
  kinds.insert(kinds.begin(), "mesh");
  const std::string kind = object.oneOf(kinds);
  if (kind == "mesh") {
    result.shape = readMeshFile(object, folder);
  } else {
    result.shape = readPrimitive(object, kind);
  }
  addPose(object, result);
  return result;
}

SceneObject readObject(StrictObject object, const std::filesystem::path& folder) {
  const bool measured = object.has("cloud") || object.has("octomap");
  SceneObject result = measured ? readMeasured(object, folder) : readShapeAndPose(object, folder);
  if (measured) addPose(object, result);
  if (object.has("band")) {
    const std::vector<double> numbers = object.numbers("band");
    result.band = located(object, "band", [&] { return bandFrom(numbers); });
  }
  object.finish();
  return result;
}

GaussianDisplacement readDisplacement(StrictObject object) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  if (object.has("mean")) {
    const std::vector<double> numbers = object.numbers("mean");
    mean = located(object, "mean", [&] { return vectorFrom(numbers, "it"); });
  }
  const std::string kind = object.oneOf({"covariance", "sigma"});
  const std::vector<double> numbers = object.numbers(kind);
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();
  if (kind == "sigma" && object.has("sigma_axes")) {
    const std::vector<double> quaternion = object.numbers("sigma_axes");
    axes = located(object, "sigma_axes", [&] { return quaternionFrom(quaternion); });
  }
  object.finish();
  return located(object, kind, [&] {
    if (kind == "covariance") return GaussianDisplacement(mean, covarianceFrom(numbers));
    return GaussianDisplacement::fromStandardDeviations(vectorFrom(numbers, "it"), axes, mean);
  });
}

PoseError readPoseError(StrictObject object) {
  PoseConvention convention = PoseConvention::world_rotation_vector;
  if (object.has("convention")) {
    const auto named = poseConventionFromString(object.text("convention"));
    if (!named)
      object.fail("convention", "none of world, body, world-exponential, body-exponential");
    convention = *named;
  }
  PoseError::Vector6 mean = PoseError::Vector6::Zero();
  if (object.has("mean")) {
    const std::vector<double> numbers = object.numbers("mean");
    mean = located(object, "mean", [&] { return sixFrom(numbers, "it"); });
  }
  const std::string kind = object.oneOf({"covariance", "sigma"});
  const std::vector<double> numbers = object.numbers(kind);
  object.finish();
  return located(object, kind, [&] {
    if (kind == "covariance") {
      return PoseError(poseCovarianceFrom(numbers), convention, mean);
    }
    return poseErrorFrom(sixFrom(numbers, "it"), convention, mean);
  });
}

ProbabilityRequest readRequest(StrictObject object, ProbabilityRequest request) {
  if (object.has("method")) {
    const auto method = methodFromString(object.text("method"));
    if (!method) object.fail("method", "unknown method");
    request.method = *method;
  }
  if (object.has("contact")) {
    const auto contact = contactFromString(object.text("contact"));
    if (!contact) object.fail("contact", "none of fcl, solid, contained");
    request.contact = *contact;
  }
  const auto readNumber = [&](const char* key, auto& value) {
    if (object.has(key)) value = object.number(key);
  };
  readNumber("relative_tolerance", request.relative_tolerance);
  readNumber("absolute_tolerance", request.absolute_tolerance);
  readNumber("threshold", request.threshold);
  readNumber("time_limit", request.time_limit);
  readNumber("confidence", request.confidence);
  if (object.has("samples")) request.samples = object.count("samples");
  if (object.has("max_cells")) request.max_cells = object.count("max_cells");
  if (object.has("max_memory")) request.max_memory = object.count("max_memory");
  if (object.has("seed")) request.seed = object.count("seed");
  object.finish();
  return request;
}

}  // namespace fcl_prob::detail
