// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <set>

#include "base/symmetric_axes.h"
#include "cli/drawn_shapes.h"
#ifdef FCL_PROB_HAS_ROBOT
#include "cli/export_motion.h"
#endif
#include "cli/gltf_file.h"
#include "cli/output.h"
#include "cli/picture_colours.h"
#include "cli/random_displacement.h"
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

ColouredMesh uniform(const std::string& name, TriangleMesh mesh, const Colour& colour) {
  const std::vector<Colour> colours(mesh.vertices.size(), colour);
  return {name, std::move(mesh), colours};
}

/// Copies of A where its pose may be, faint.
void addDisplacedCopies(const Scene& scene, const LoadedObject& object, std::uint64_t seed,
                        std::vector<ColouredMesh>& meshes) {
  constexpr std::uint64_t kCopies = 12;
  const PoseError& error = *scene.pose_error;
  const auto solver = detail::symmetricAxes(error.covariance());
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

  std::vector<ColouredMesh> meshes{{"A", a, colours}, uniform("B", b, touchedColour())};
  const Eigen::Vector3d centre = nearestPoint(a, b);
  for (const int deviations : {1, 2, 3}) {
    meshes.push_back(uniform(std::to_string(deviations) + " sigma",
                             drawnEllipsoid(around_mean, deviations, centre),
                             ellipsoidColour(deviations)));
  }
  if (scene.pose_error) addDisplacedCopies(scene, nominal_a, arguments.seed, meshes);
  return meshes;
}

GltfForm formOf(const std::string& output) {
  const std::optional<GltfForm> form = gltfFormOf(output);
  if (!form) throw InvalidRequest("--output: the file name must end in .glb or .gltf");
  return *form;
}

int runExport(const ExportArguments& arguments) {
  const GltfForm form = formOf(arguments.output);
  writeFile(arguments.output, gltfOf(picture(arguments), form));
  return kAnswered;
}

#ifdef FCL_PROB_HAS_ROBOT

void addMotionOptions(CLI::App& command, MotionExportArguments& arguments) {
  command.add_option("--motion", arguments.motion,
                     "Of robots: JSON or CSV file of waypoints in place of the scene's");
  command.add_option("--largest-step", arguments.largest_step,
                     "Of robots: add waypoints such that no joint moves further at once");
  command
      .add_option("--poses", arguments.poses,
                  "Of robots: waypoints that are shown, the likeliest to collide among them")
      ->check(CLI::Range(1, 1'000'000));
  command.add_flag("--still", arguments.still, "Of robots: nothing that moves");
  command.add_flag("--allow-outside-limits", arguments.allow_outside_limits,
                   "Of robots: also states beyond the limits of joints");
}

/// An option that says nothing about a scene of this kind shall not be taken for one that does.
void refuseOptionsOfOthers(const CLI::App& command, bool has_robot) {
  const std::set<std::string> of_robots{"--motion", "--largest-step", "--poses", "--still",
                                        "--allow-outside-limits"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "--scene" || name == "--output") continue;
    if ((of_robots.count(name) > 0) == has_robot) continue;
    throw InvalidRequest(
        name + (has_robot ? ": not of a scene with a robot" : ": only of a scene with a robot"));
  }
}

int runExportOfAny(const CLI::App& command, const ExportArguments& arguments,
                   MotionExportArguments motion) {
  const std::string& scene = arguments.scene.scene_file;
  const bool has_robot = !scene.empty() && isRobotScene(scene);
  refuseOptionsOfOthers(command, has_robot);
  if (!has_robot) return runExport(arguments);
  motion.form = formOf(arguments.output);
  motion.scene = scene;
  motion.output = arguments.output;
  return exportMotion(motion);
}

#endif

}  // namespace

void addExportCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App& command = *app.add_subcommand(
      "export",
      "The scene as a glTF file: A coloured by where it is touched, B, and the "
      "displacement's ellipsoids of 1, 2 and 3 sigma at the point of A nearest to B. Of a robot's "
      "scene: the robot at waypoints of its motion, coloured by P, and the motion");
  addSceneOptions(command, arguments->scene);
  command
      .add_option("--samples", arguments->samples, "Displacements that are tried for the colours")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seed", arguments->seed, "Fixes them")->check(CLI::NonNegativeNumber);
  command
      .add_option("--output", arguments->output,
                  "The file to write, FILE.glb or, as JSON, FILE.gltf")
      ->required();
#ifdef FCL_PROB_HAS_ROBOT
  auto motion = std::make_shared<MotionExportArguments>();
  addMotionOptions(command, *motion);
  command.callback([arguments, motion, &command, &exit_code] {
    exit_code = runExportOfAny(command, *arguments, *motion);
  });
#else
  command.callback([arguments, &exit_code] { exit_code = runExport(*arguments); });
#endif
}

}  // namespace fcl_prob::cli
