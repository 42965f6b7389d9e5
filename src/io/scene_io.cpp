// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/scene_io.h"

#include <filesystem>

#include "io/scene_parts.h"
#include "io/strict_json.h"

namespace fcl_prob {

void setPoseError(const PoseError& error, Scene& scene) {
  scene.pose_error = error;
  scene.displacement = error.inWorldFrame(scene.a.pose).translation();
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
  scene.request.band_a = scene.a.band;
  scene.request.band_b = scene.b.band;
  return scene;
}

}  // namespace fcl_prob
