// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sweep/prepared_scenes.h"

#include <sstream>

namespace fcl_prob::sweep {

ProbabilityResult PreparedPair::answer(const Scene& scene,
                                       const ProbabilityRequest& request) const {
  ProbabilityResult result;
  if (scene.pose_error) {
    std::call_once(once_, [this] { pose_query_ = std::make_unique<PreparedPoseQuery>(a_, b_); });
    pose_query_->collisionProbability(scene.a.pose, scene.b.pose, *scene.pose_error, request,
                                      result);
  } else {
    query_.collisionProbability(scene.a.pose, scene.b.pose, scene.displacement, request, result);
  }
  return result;
}

PreparedScenes::Geometry PreparedScenes::geometryOf(const SceneObject& object) {
  if (const auto* primitive = std::get_if<PrimitiveShape>(&object.shape)) return *primitive;
  const MeshFile& mesh = std::get<MeshFile>(object.shape);
  if (mesh.given) return buildModel<fcl::OBBRSSd>(*mesh.given);
  std::ostringstream key;
  key << std::hexfloat << mesh.options.scale << mesh.options.normalize << mesh.path;
  return meshes_.get(key.str(),
                     [&]() -> Geometry { return buildModel<fcl::OBBRSSd>(mesh.read()); });
}

void PreparedScenes::loadMeshes(const QueryLine& query) {
  if (query.scene_file.empty()) {
    loadMesh(*query.a);
    loadMesh(*query.b);
    return;
  }
  try {
    const auto scene = sceneOfFile(query.scene_file);
    loadMesh(scene->a);
    loadMesh(scene->b);
  } catch (const std::exception&) {
  }
}

std::shared_ptr<const Scene> PreparedScenes::sceneOfFile(const std::string& path) {
  return scenes_.get(path, [&] { return std::make_shared<const Scene>(loadScene(path)); });
}

void PreparedScenes::loadMesh(const SceneObject& object) {
  if (!std::holds_alternative<MeshFile>(object.shape)) return;
  try {
    geometryOf(object);
  } catch (const std::exception&) {
  }
}

SceneWithPair PreparedScenes::of(const QueryLine& query) {
  const auto pairOf = [this](const Scene& scene) {
    return std::make_shared<const PreparedPair>(geometryOf(scene.a), geometryOf(scene.b));
  };
  if (query.scene_file.empty()) {
    SceneWithPair inline_scene{sceneOf(query, {}), nullptr};
    inline_scene.pair = pairs_.get(query.shapes_key, [&] { return pairOf(inline_scene.scene); });
    return inline_scene;
  }
  const auto base = sceneOfFile(query.scene_file);
  return {sceneOf(query, *base),
          pairs_of_files_.get(query.scene_file, [&] { return pairOf(*base); })};
}

}  // namespace fcl_prob::sweep
