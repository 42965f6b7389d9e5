// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/scene_io.h"

#include <filesystem>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/octomap_io.h"
#include "io/quantities.h"
#include "io/scene_parts.h"
#include "io/strict_json.h"

namespace fcl_prob {

void setPoseError(const PoseError& error, Scene& scene) {
  scene.pose_error = error;
  scene.displacement = error.inWorldFrame(scene.a.pose).translation();
}

SceneObject octomapObject(const std::string& path, bool unknown_is_occupied) {
  const auto map =
      loadOctomap(path, unknown_is_occupied ? UnknownCells::occupied : UnknownCells::free);
  SceneObject object;
  object.shape = PrimitiveShape(map);
  object.band = bandOf(*map);
  return object;
}

SceneObject cloudObject(const std::string& json_path) {
  const nlohmann::json document = detail::parseJsonFile(json_path);
  const std::filesystem::path folder = std::filesystem::path(json_path).parent_path();
  detail::StrictObject root(document, json_path);
  const auto mesh = [&](const char* key) {
    return MeshFile{(folder / root.text(key)).lexically_normal().string(), {}};
  };
  SceneObject object;
  object.shape = mesh("surface");
  object.possible = mesh("obstacle");
  object.possible_is_solid = root.boolean("obstacle_is_solid");
  try {
    object.band = detail::bandFrom(root.numbers("band"));
    object.shared_covariance = detail::covarianceFrom(root.numbers("covariance"));
    GaussianDisplacement(Eigen::Vector3d::Zero(), object.shared_covariance);  // validates
  } catch (const FileError&) {
    throw;
  } catch (const Exception& error) {
    throw FileError(json_path + ": " + error.what());
  }
  return object;
}

void addSharedErrors(Scene& scene) {
  for (const SceneObject* object : {&scene.a, &scene.b}) {
    if (object->shared_covariance.isZero(0.0)) continue;
    if (scene.pose_error) {
      throw InvalidRequest("a cloud with a shared covariance beside an error of A's pose");
    }
    const Eigen::Matrix3d& turn = object->pose.linear();
    const GaussianDisplacement shared(Eigen::Vector3d::Zero(),
                                      turn * object->shared_covariance * turn.transpose());
    scene.displacement = GaussianDisplacement::fromIndependent(scene.displacement, shared);
  }
}

Scene loadScene(const std::string& path) {
  const nlohmann::json document = detail::parseJsonFile(path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  detail::StrictObject root(document, path);
  if (root.has("description")) root.text("description");
  Scene scene;
  scene.a = detail::readObject(root.object("a"), folder);
  scene.b = detail::readObject(root.object("b"), folder);
  if (root.oneOf({"displacement", "pose_error"}) == "displacement") {
    scene.displacement = detail::readDisplacement(root.object("displacement"));
  } else {
    setPoseError(detail::readPoseError(root.object("pose_error")), scene);
  }
  if (root.has("request")) scene.request = detail::readRequest(root.object("request"));
  root.finish();
  addSharedErrors(scene);
  scene.request.band_a = scene.a.band;
  scene.request.band_b = scene.b.band;
  return scene;
}

}  // namespace fcl_prob
