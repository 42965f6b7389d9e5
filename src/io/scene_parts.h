// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What several kinds of scene files are made of (docs/scene_format.md).
#pragma once

#include <filesystem>
#include <optional>

#include "fcl_prob/scene_io.h"
#include "io/strict_json.h"

namespace fcl_prob::detail {

/// Each reads a whole object, in which nothing unknown may be. \throws FileError
SceneObject readObject(StrictObject object, const std::filesystem::path& folder);
GaussianDisplacement readDisplacement(StrictObject object);
PoseError readPoseError(StrictObject object);

/// What a key says, if it is there; the caller calls finish().
std::optional<fcl::Transform3d> readPose(StrictObject& object, const std::string& key);

/// \param request  what holds where the object says nothing
ProbabilityRequest readRequest(StrictObject object, ProbabilityRequest request = {});

/// The same of an object that has other keys besides: the caller calls finish().
/// \param folder  that mesh paths are relative to
SceneObject readShapeAndPose(StrictObject& object, const std::filesystem::path& folder);

/// As the readers take them: a mesh with its vertices and triangles, and a request.
nlohmann::ordered_json meshJson(const TriangleMesh& mesh);
nlohmann::ordered_json requestJson(const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
