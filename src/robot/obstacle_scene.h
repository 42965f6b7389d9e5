// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The obstacles of a robot's scene file, and what else it names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fcl_prob/mesh_io.h"
#include "fcl_prob/robot_scene.h"
#include "io/strict_json.h"

namespace fcl_prob::detail {

/// A path that a scene in `folder` names.
std::string besideScene(const std::filesystem::path& folder, const std::string& path);

/// The keys that say which robot and which of its links. \returns the path of its URDF
std::string readUrdfOptions(StrictObject& object, const std::filesystem::path& folder,
                            RobotOptions& options);

/// \throws FileError
RobotScene::PlacedObstacle readObstacle(StrictObject object, const std::filesystem::path& folder);

/// Reads the meshes. \param states  where it is over time, if it moves
/// \throws FileError, InvalidGeometry, InvalidRequest
Obstacle loadObstacle(const RobotScene::PlacedObstacle& obstacle,
                      const std::vector<ObstacleState>& states);

/// Of an attached object or an obstacle. \returns what a query takes of its shape
template <class Of>
Of withShape(Of result, const SceneObject& object) {
  if (const auto* primitive = std::get_if<PrimitiveShape>(&object.shape)) {
    result.geometry = *primitive;
    return result;
  }
  const TriangleMesh mesh = std::get<MeshFile>(object.shape).read();
  result.geometry = buildModel<fcl::OBBRSSd>(mesh);
  result.coordinate_error = mesh.coordinate_error;
  result.notes = mesh.notes;
  return result;
}

}  // namespace fcl_prob::detail
