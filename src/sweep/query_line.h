// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One line of a file of queries (docs/sweep.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "fcl_prob/scene_io.h"

namespace fcl_prob::sweep {

/// A line as it stands in the file.
struct NumberedLine {
  std::size_t number = 0;  ///< from 1
  std::string text;        ///< without its end
  bool too_long = false;   ///< and so is not in `text`
};

/// Eight hexadecimal digits: which query a result belongs to.
std::string checksumOf(const NumberedLine& line);

/// What a line says.
struct QueryLine {
  nlohmann::json id;  ///< a text, a whole number or null

  /// Of the scene that varies; empty if the shapes stand in the line itself.
  std::string scene_file;

  /// Those shapes, and what tells them apart from other ones, their poses apart.
  std::optional<SceneObject> a;
  std::optional<SceneObject> b;
  std::string shapes_key;

  std::optional<fcl::Transform3d> pose_a;
  std::optional<fcl::Transform3d> pose_b;
  std::optional<GaussianDisplacement> displacement;
  std::optional<PoseError> pose_error;
  std::optional<Eigen::Vector3d> mean;
  nlohmann::json request;  ///< an object; empty if there is none
};

/// \param folder  that paths are relative to
/// \throws FileError, after which `query` has the id if that could be read
void readQueryLine(const NumberedLine& line, const std::filesystem::path& folder, QueryLine& query);

/// The scene that the line asks about. \param base  that of its scene file, or an empty one
/// \throws FileError
Scene sceneOf(const QueryLine& query, Scene base);

}  // namespace fcl_prob::sweep
