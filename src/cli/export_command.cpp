// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/export_command.h"

#include <fcl/narrowphase/distance.h>

#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "cli/drawn_shapes.h"
#include "cli/gltf_file.h"
#include "cli/output.h"
#include "cli/random_frames.h"
#include "cli/run.h"
#include "cli/scene_arguments.h"
#include "cli/touch_map.h"

namespace fcl_prob::cli {
namespace {

struct ExportArguments {
  SceneArguments scene;
  std::size_t samples = 20'000;
  std::uint64_t seed = 1;
  std::string output;
};

/// From grey through yellow to red. The root makes rarely touched parts visible.
Colour heat(double likelihood) {
  static const std::array<Colour, 4> kStops{
      Colour(0.80F, 0.84F, 0.88F, 1.0F), Colour(1.0F, 0.85F, 0.25F, 1.0F),
      Colour(1.0F, 0.30F, 0.03F, 1.0F), Colour(0.60F, 0.0F, 0.02F, 1.0F)};
  const double position = std::sqrt(std::clamp(likelihood, 0.0, 1.0)) * (kStops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const auto fraction = static_cast<float>(position - static_cast<double>(stop));
  return (1.0F - fraction) * kStops[stop] + fraction * kStops[stop + 1];
}

/// The point of A that is nearest to B; the middle of A if they overlap.
Eigen::Vector3d nearestPoint(const TriangleMesh& a, const TriangleMesh& b) {
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const auto model_a = buildModel<fcl::OBBRSSd>(a);
  const auto model_b = buildModel<fcl::OBBRSSd>(b);
  fcl::DistanceResultd result;
  fcl::distance(model_a.get(), identity, model_b.get(), identity, fcl::DistanceRequestd(true),
                result);
  return result.min_distance > 0.0 ? result.nearest_points[0] : model_a->aabb_local.center();
}

ColouredMesh uniform(const std::string& name, TriangleMesh mesh, const Colour& colour) {
  const std::vector<Colour> colours(mesh.vertices.size(), colour);
  return {name, std::move(mesh), colours};
}

/// Copies of A where its pose may be, faint.
void addDisplacedCopies(const Scene& scene, const LoadedObject& object, std::uint64_t seed,
                        std::vector<ColouredMesh>& meshes) {
  constexpr std::uint64_t kCopies = 12;
  const PoseError& error = *scene.pose_error;
  const Eigen::SelfAdjointEigenSolver<PoseError::Matrix6> solver(error.covariance());
  const PoseError::Matrix6 root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const Whitening unit(GaussianDisplacement::fromStandardDeviations({1.0, 1.0, 1.0}));
  for (std::uint64_t i = 0; i < kCopies; ++i) {
    PoseError::Vector6 normals;
    normals << randomDisplacement(unit, seed, 2 * i), randomDisplacement(unit, seed, 2 * i + 1);
    LoadedObject copy = object;
    copy.pose = displacedPose(object.pose, error.convention(), error.mean() + root * normals);
    meshes.push_back(uniform("A, sample " + std::to_string(i + 1), drawnMesh(copy),
                             Colour(0.80F, 0.84F, 0.88F, 0.12F)));
  }
}

/// A at its mean pose, B, and the ellipsoids around the place where they are closest.
std::vector<ColouredMesh> picture(const ExportArguments& arguments) {
  const Scene scene = sceneFrom(arguments.scene);
  const LoadedObject nominal_a = loadObject(scene.a);
  LoadedObject object_a = nominal_a;
  if (scene.pose_error) {
    object_a.pose =
        displacedPose(object_a.pose, scene.pose_error->convention(), scene.pose_error->mean());
  } else {
    object_a.pose.pretranslate(scene.displacement.mean());
  }
  const TriangleMesh a = drawnMesh(object_a);
  const TriangleMesh b = drawnMesh(loadObject(scene.b));
  const GaussianDisplacement around_mean = scene.displacement.withMean(Eigen::Vector3d::Zero());

  const TouchMap map = touchMap(a, b, around_mean, arguments.samples, arguments.seed);
  std::cerr << "fcl_prob: " << map.hits << " of " << map.samples << " samples touch\n";
  std::vector<Colour> colours;
  for (const double likelihood : map.likelihood) colours.push_back(heat(likelihood));

  std::vector<ColouredMesh> meshes{{"A", a, colours},
                                   uniform("B", b, Colour(0.45F, 0.65F, 1.0F, 1.0F))};
  const Eigen::Vector3d centre = nearestPoint(a, b);
  for (const int deviations : {1, 2, 3}) {
    const float opacity = 0.6F / static_cast<float>(deviations);
    meshes.push_back(uniform(std::to_string(deviations) + " sigma",
                             drawnEllipsoid(around_mean, deviations, centre),
                             Colour(0.05F, 0.6F, 0.2F, opacity)));
  }
  if (scene.pose_error) addDisplacedCopies(scene, nominal_a, arguments.seed, meshes);
  return meshes;
}

int runExport(const ExportArguments& arguments) {
  if (std::filesystem::path(arguments.output).extension() != ".glb") {
    throw InvalidRequest("--output: the file name must end in .glb");
  }
  writeFile(arguments.output, glbOf(picture(arguments)));
  return kAnswered;
}

}  // namespace

void addExportCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App& command = *app.add_subcommand(
      "export",
      "The scene as a glTF file: A coloured by where it is touched, B, and the "
      "displacement's ellipsoids of 1, 2 and 3 sigma at the point of A nearest to B");
  addSceneOptions(command, arguments->scene);
  command
      .add_option("--samples", arguments->samples, "Displacements that are tried for the colours")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seed", arguments->seed, "Fixes them")->check(CLI::NonNegativeNumber);
  command.add_option("--output", arguments->output, "The file to write, FILE.glb")->required();
  command.callback([arguments, &exit_code] { exit_code = runExport(*arguments); });
}

}  // namespace fcl_prob::cli
