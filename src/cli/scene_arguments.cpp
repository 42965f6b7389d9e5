// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/scene_arguments.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/geometry.h"
#include "io/quantities.h"
#include "io/text_reader.h"

namespace fcl_prob::cli {
namespace {

constexpr const char* kPoseHelp =
    "x,y,z in metres; after that qw,qx,qy,qz, or roll,pitch,yaw in radians about fixed axes";

/// Runs `convert` and puts the name of the option before whatever it complains of.
template <typename Convert>
auto ofOption(const std::string& option, const Convert& convert) {
  try {
    return convert();
  } catch (const Exception& error) {
    throw InvalidRequest(option + ": " + error.what());
  }
}

std::optional<fcl::Transform3d> poseOption(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  return ofOption(option, [&] { return detail::poseFrom(detail::numberList(text)); });
}

std::optional<Band> bandOption(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  return ofOption(option, [&] { return detail::bandFrom(detail::numberList(text)); });
}

GaussianDisplacement displacementFrom(const SceneArguments& arguments) {
  const Eigen::Vector3d mean =
      arguments.mean.empty() ? Eigen::Vector3d::Zero() : ofOption("--mean", [&] {
        return detail::vectorFrom(detail::numberList(arguments.mean), "a mean");
      });
  if (!arguments.covariance.empty()) {
    return ofOption("--covariance", [&] {
      return GaussianDisplacement(mean,
                                  detail::covarianceFrom(detail::numberList(arguments.covariance)));
    });
  }
  const Eigen::Quaterniond axes =
      arguments.sigma_axes.empty() ? Eigen::Quaterniond::Identity() : ofOption("--sigma-axes", [&] {
        return detail::quaternionFrom(detail::numberList(arguments.sigma_axes));
      });
  return ofOption("--sigma", [&] {
    const Eigen::Vector3d sigma = detail::vectorFrom(detail::numberList(arguments.sigma), "sigma");
    return GaussianDisplacement::fromStandardDeviations(sigma, axes, mean);
  });
}

PoseError poseErrorFrom(const SceneArguments& arguments) {
  PoseConvention convention = PoseConvention::world_rotation_vector;
  if (arguments.pose_convention) {
    convention = detail::poseConventionFromString(*arguments.pose_convention).value();
  }
  if (!arguments.pose_covariance.empty()) {
    return ofOption("--pose-covariance", [&] {
      return PoseError(detail::poseCovarianceFrom(detail::numberList(arguments.pose_covariance)),
                       convention);
    });
  }
  return ofOption("--pose-sigma", [&] {
    return detail::poseErrorFrom(detail::sixFrom(detail::numberList(arguments.pose_sigma), "it"),
                                 convention, PoseError::Vector6::Zero());
  });
}

void applyDisplacement(const SceneArguments& arguments, Scene& scene) {
  if (!arguments.pose_covariance.empty() || !arguments.pose_sigma.empty()) {
    setPoseError(poseErrorFrom(arguments), scene);
    return;
  }
  if (!arguments.covariance.empty() || !arguments.sigma.empty()) {
    scene.displacement = displacementFrom(arguments);
    scene.pose_error.reset();
    return;
  }
  if (arguments.scene_file.empty()) {
    throw InvalidRequest("needs --covariance or --sigma, or --pose-sigma or --pose-covariance");
  }
  // The pose of A may be another one than the file's.
  if (scene.pose_error) setPoseError(*scene.pose_error, scene);
  if (!arguments.mean.empty()) {
    if (scene.pose_error) throw InvalidRequest("--mean: the scene file has a pose_error");
    scene.displacement = ofOption("--mean", [&] {
      return scene.displacement.withMean(
          detail::vectorFrom(detail::numberList(arguments.mean), "a mean"));
    });
  }
}

void applyMeshOptions(const std::string& option, bool normalize, std::optional<double> scale,
                      SceneObject& object) {
  auto* mesh = std::get_if<MeshFile>(&object.shape);
  if (mesh == nullptr && scale) throw InvalidRequest(option + ": the object is not a mesh");
  if (mesh == nullptr) return;
  if (normalize) mesh->options.normalize = true;
  if (scale) mesh->options.scale = *scale;
}

void applyRequest(const SceneArguments& arguments, ProbabilityRequest& request) {
  if (arguments.method && *arguments.method != kPartsBounds) {
    const auto method = methodFromString(*arguments.method);
    if (!method) {
      std::string names;
      for (const std::string& name : methodNames()) names += " " + name;
      names += std::string(" ") + kPartsBounds;
      throw InvalidRequest("--method: unknown method " + detail::inQuotes(*arguments.method) +
                           "; known are" + names);
    }
    request.method = *method;
  }
  if (arguments.contact) {
    const auto contact = detail::contactFromString(*arguments.contact);
    if (!contact) throw InvalidRequest("--contact: none of fcl, solid, contained");
    request.contact = *contact;
  }
  const auto apply = [](const auto& option, auto& field) {
    if (option) field = *option;
  };
  apply(arguments.relative_tolerance, request.relative_tolerance);
  apply(arguments.absolute_tolerance, request.absolute_tolerance);
  apply(arguments.threshold, request.threshold);
  apply(arguments.time_limit, request.time_limit);
  apply(arguments.confidence, request.confidence);
  apply(arguments.samples, request.samples);
  apply(arguments.max_cells, request.max_cells);
  apply(arguments.max_memory, request.max_memory);
  apply(arguments.seed, request.seed);
  apply(arguments.threads, request.threads);
  if (arguments.gradient) request.gradient = true;
}

/// A mesh, a map, or what was made of a cloud, by the ending of the file's name.
SceneObject objectFrom(const std::string& path, const SceneArguments& arguments) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".bt" || ending == ".ot") {
    return octomapObject(path, arguments.unknown_cells == "occupied");
  }
  if (ending == ".json") return cloudObject(path);
  SceneObject object;
  object.shape = MeshFile{path, {}};
  return object;
}

Scene baseScene(const SceneArguments& arguments) {
  if (!arguments.scene_file.empty()) return loadScene(arguments.scene_file);
  if (arguments.mesh_b.empty()) throw InvalidRequest("needs two mesh files, or --scene FILE.json");
  Scene scene;
  scene.a = objectFrom(arguments.mesh_a, arguments);
  scene.b = objectFrom(arguments.mesh_b, arguments);
  scene.request.band_a = scene.a.band;
  scene.request.band_b = scene.b.band;
  return scene;
}

}  // namespace

void addSceneOptions(CLI::App& command, SceneArguments& arguments) {
  command.option_defaults()->group("Objects");
  auto* mesh_a = command.add_option(
      "A", arguments.mesh_a,
      "The displaced object: a mesh, an OctoMap file, or the report of reconstruct");
  auto* mesh_b = command.add_option("B", arguments.mesh_b, "The other object");
  command.add_option("--scene", arguments.scene_file, "Scene file (JSON) instead of A and B")
      ->excludes(mesh_a)
      ->excludes(mesh_b);
  command.add_flag("--normalize", arguments.normalize,
                   "Centre each mesh and make its longest side 1 m, before scale and pose");
  command.add_option("--scale-a", arguments.scale_a, "Factor on the coordinates of A");
  command.add_option("--scale-b", arguments.scale_b, "Factor on the coordinates of B");
  command.add_option("--pose-a", arguments.pose_a, kPoseHelp);
  command.add_option("--pose-b", arguments.pose_b, kPoseHelp);
  command
      .add_option("--unknown-cells", arguments.unknown_cells,
                  "Of OctoMap files: what is made of cells that they say nothing about")
      ->check(CLI::IsMember({"free", "occupied"}));
  command.add_option("--band-a", arguments.band_a,
                     "How far the true shape of A may be from its model: d or outward,inward in "
                     "metres");
  command.add_option("--band-b", arguments.band_b, "The same of B");
  command.option_defaults()->group("Error");
  auto* covariance = command.add_option("--covariance", arguments.covariance,
                                        "xx,xy,xz,yy,yz,zz in square metres");
  auto* sigma = command.add_option("--sigma", arguments.sigma,
                                   "Three standard deviations in metres, instead of --covariance");
  sigma->excludes(covariance);
  command.add_option("--sigma-axes", arguments.sigma_axes, "Rotation of their axes: qw,qx,qy,qz")
      ->needs(sigma);
  auto* mean = command.add_option("--mean", arguments.mean, "Mean displacement x,y,z in metres");
  auto* pose_sigma =
      command.add_option("--pose-sigma", arguments.pose_sigma,
                         "Standard deviations x,y,z,rx,ry,rz of A's pose, metres and radians");
  auto* pose_covariance =
      command.add_option("--pose-covariance", arguments.pose_covariance,
                         "Covariance of A's pose row by row, order x,y,z,rx,ry,rz: 36 numbers, or "
                         "the upper triangle's 21");
  pose_sigma->excludes(covariance)->excludes(sigma)->excludes(mean);
  pose_covariance->excludes(covariance)->excludes(sigma)->excludes(mean)->excludes(pose_sigma);
  command
      .add_option("--pose-convention", arguments.pose_convention,
                  "Their meaning: rotation vectors in the world's or the body's frame, or "
                  "exponentials of SE(3); default world")
      ->check(CLI::IsMember({"world", "body", "world-exponential", "body-exponential"}));
  command.option_defaults()->group("Output");
}

void addRequestOptions(CLI::App& command, SceneArguments& arguments) {
  command.option_defaults()->group("Question");
  std::string methods;
  for (const std::string& name : methodNames()) methods += (methods.empty() ? "" : ", ") + name;
  command.add_option("--method", arguments.method, "One of " + methods + ", " + kPartsBounds);
  command
      .add_option("--contact", arguments.contact,
                  "fcl: meshes are surfaces; solid: closed meshes are solids; contained: P that A "
                  "is wholly within B")
      ->check(CLI::IsMember({"fcl", "solid", "contained"}));
  command.add_option("--threshold", arguments.threshold,
                     "Stop as soon as it is certain on which side of this the probability is");
  command.add_option("--relative-tolerance,--tolerance", arguments.relative_tolerance,
                     "Width of the interval relative to its upper end");
  command.add_option("--absolute-tolerance", arguments.absolute_tolerance,
                     "Width of the interval that is always good enough");
  command.add_option("--confidence", arguments.confidence,
                     "delta of general-pcd; coverage of the interval of sampling methods");
  command.add_option("--seed", arguments.seed, "Fixes all samples")->check(CLI::NonNegativeNumber);
  command.add_option("--bv", arguments.bounding_volume, "Bounding volumes of the meshes' trees")
      ->check(CLI::IsMember(boundingVolumeNames()));
  command
      .add_option("--leaves", arguments.leaves,
                  "What general-pcd's trees end at: triangles, or convex parts of the meshes")
      ->check(CLI::IsMember({"triangles", "parts"}));
  command.option_defaults()->group("Limits");
  command.add_option("--time-limit", arguments.time_limit,
                     "Seconds; if nothing says so 20, of compare 10 a run");
  command.add_option("--samples", arguments.samples, "Number of samples at most")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--max-cells", arguments.max_cells,
                  "Cells of a partition, or random configurations, at most")
      ->check(CLI::PositiveNumber);
  command.add_option("--max-memory", arguments.max_memory, "Bytes of a partition at most")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--threads", arguments.threads, "Of one query, too; results do not depend on it")
      ->check(CLI::NonNegativeNumber);
  command.option_defaults()->group("Output");
}

Scene sceneFrom(const SceneArguments& arguments) {
  Scene scene = baseScene(arguments);
  applyMeshOptions("--scale-a", arguments.normalize, arguments.scale_a, scene.a);
  applyMeshOptions("--scale-b", arguments.normalize, arguments.scale_b, scene.b);
  if (const auto pose = poseOption("--pose-a", arguments.pose_a)) scene.a.pose = *pose;
  if (const auto band = bandOption("--band-a", arguments.band_a)) scene.request.band_a = *band;
  if (const auto band = bandOption("--band-b", arguments.band_b)) scene.request.band_b = *band;
  if (const auto pose = poseOption("--pose-b", arguments.pose_b)) scene.b.pose = *pose;
  const bool displaced_by_options = !arguments.covariance.empty() || !arguments.sigma.empty() ||
                                    !arguments.pose_sigma.empty() ||
                                    !arguments.pose_covariance.empty();
  applyDisplacement(arguments, scene);
  // Those of a scene file's displacement are in it.
  if (displaced_by_options) addSharedErrors(scene);
  applyRequest(arguments, scene.request);
  return scene;
}

PartsUse partsUse(const SceneArguments& arguments) {
  if (arguments.method && *arguments.method == kPartsBounds) return PartsUse::bounds;
  return arguments.leaves == "parts" ? PartsUse::leaves : PartsUse::none;
}

}  // namespace fcl_prob::cli
