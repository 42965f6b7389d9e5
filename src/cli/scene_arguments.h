// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The options that describe a scene and a request, shared by the subcommands.
#pragma once

#include <optional>
#include <string>

#include "cli/parts_scene.h"
#include "fcl_prob/scene_io.h"

namespace CLI {
class App;
}

namespace fcl_prob::cli {

/// What the command line says, before any file is opened.
struct SceneArguments {
  std::string mesh_a;
  std::string mesh_b;
  std::string scene_file;
  bool normalize = false;
  std::optional<double> scale_a;
  std::optional<double> scale_b;
  std::string pose_a;
  std::string pose_b;
  std::string unknown_cells = "free";
  std::string band_a;
  std::string band_b;
  std::string covariance;
  std::string sigma;
  std::string sigma_axes;
  std::string mean;
  std::string pose_sigma;
  std::string pose_covariance;
  std::optional<std::string> pose_convention;

  std::optional<std::string> method;
  std::string bounding_volume = "obbrss";
  std::string leaves = "triangles";
  std::optional<double> relative_tolerance;
  std::optional<double> absolute_tolerance;
  std::optional<double> threshold;
  std::optional<double> time_limit;
  std::optional<double> confidence;
  std::optional<std::size_t> samples;
  std::optional<std::size_t> max_cells;
  std::optional<std::size_t> max_memory;
  std::optional<std::uint64_t> seed;
  std::optional<unsigned> threads;
  std::optional<std::string> contact;
  bool gradient = false;
};

/// Adds the options to `command`; parsing fills `arguments`, which must live as long. In the help
/// what a command adds afterwards is in the group Output.
void addSceneOptions(CLI::App& command, SceneArguments& arguments);

/// Adds the options of the request (method, tolerances, limits).
void addRequestOptions(CLI::App& command, SceneArguments& arguments);

/// The scene that the arguments describe: the scene file's, if there is one, with whatever the
/// command line says in its place. Meshes are not read. \throws Exception that begins with the
/// option at fault.
Scene sceneFrom(const SceneArguments& arguments);

/// Whether the method or --leaves asks for convex parts.
PartsUse partsUse(const SceneArguments& arguments);

}  // namespace fcl_prob::cli
