// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/number_text.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/run.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/reconstruction.h"
#include "io/quantities.h"

namespace fcl_prob::cli {
namespace {

struct ReconstructArguments {
  std::string cloud;
  std::string output;
  std::string report;
  std::string sensor = "kinect-nguyen";
  std::string unseen = "report";
  std::string meshing = "greedy";
  std::string crop;
  std::string pose_sigma;
  std::string pose_covariance;
  ReconstructionRequest request;
  bool json = false;
};

detail::Numbers numbersOf(const std::string& option, const std::string& text, std::size_t count) {
  const detail::Numbers numbers = detail::numberList(text);
  if (numbers.size() == count) return numbers;
  throw InvalidRequest(option + " needs " + std::to_string(count) + " numbers, not " +
                       std::to_string(numbers.size()));
}

Eigen::AlignedBox3d cropFrom(const std::string& text) {
  const detail::Numbers n = numbersOf("--crop", text, 6);
  const Eigen::AlignedBox3d box(Eigen::Vector3d(n[0], n[1], n[2]),
                                Eigen::Vector3d(n[3], n[4], n[5]));
  if (box.isEmpty()) throw InvalidRequest("--crop: the box x,y,z,X,Y,Z is empty");
  return box;
}

void readRequest(ReconstructArguments& arguments) {
  ReconstructionRequest& request = arguments.request;
  request.sensor = sensorModelFromString(arguments.sensor, request.focal_length);
  request.unseen = arguments.unseen == "free"       ? UnseenSpace::free
                   : arguments.unseen == "occupied" ? UnseenSpace::occupied
                                                    : UnseenSpace::report;
  request.meshing = arguments.meshing == "poisson" ? PointMeshing::poisson : PointMeshing::greedy;
  if (!arguments.crop.empty()) request.crop = cropFrom(arguments.crop);
  if (!arguments.pose_sigma.empty()) {
    const detail::Numbers sigma = numbersOf("--camera-sigma", arguments.pose_sigma, 6);
    for (int i = 0; i < 6; ++i) request.sensor_pose_covariance(i, i) = sigma[i] * sigma[i];
  }
  if (!arguments.pose_covariance.empty()) {
    request.sensor_pose_covariance =
        detail::poseCovarianceFrom(numbersOf("--camera-covariance", arguments.pose_covariance, 21));
  }
}

std::string summaryOf(const Reconstruction& result) {
  std::string text = std::to_string(result.surface.triangles.size()) + " triangles of " +
                     numberText(100.0 * result.share_used, 3) + " % of the points; band " +
                     numberText(1e3 * result.band.outward, 3) + " mm outwards, " +
                     numberText(1e3 * result.band.inward, 3) + " mm inwards; largest hole " +
                     numberText(1e3 * result.largest_hole, 3) + " mm\n";
  for (const std::string& note : result.notes) text += note + '\n';
  return text;
}

int runReconstruct(ReconstructArguments& arguments) {
  readRequest(arguments);
  const std::filesystem::path mesh(arguments.output);
  if (mesh.extension() != ".obj") throw InvalidRequest("--output: the mesh must be a .obj file");
  const std::filesystem::path folder = mesh.parent_path();
  const std::string obstacle = mesh.stem().string() + "-obstacle.obj";
  const std::string report = arguments.report.empty()
                                 ? (folder / (mesh.stem().string() + ".json")).string()
                                 : arguments.report;
  noteInterrupts();
  ProgressBar bar("fcl_prob reconstruct");
  arguments.request.on_progress = [&bar](double done) {
    bar.show(done, "");
    return !interrupted();
  };
  const PointCloud cloud = loadPointCloud(arguments.cloud);
  Reconstruction result;
  try {
    result = reconstruct(cloud, arguments.request);
  } catch (const InvalidGeometry& error) {
    throw InvalidGeometry(arguments.cloud + ": " + error.what());
  }
  const auto fromReport = [&](const std::filesystem::path& file) {
    const auto from = std::filesystem::absolute(report).parent_path();
    return std::filesystem::absolute(file).lexically_relative(from).string();
  };
  const std::string json = toJson(result, fromReport(mesh), fromReport(folder / obstacle));
  writeFile(arguments.output, toObj(result.surface));
  writeFile((folder / obstacle).string(), toObj(result.obstacle));
  writeFile(report, json);
  deliver(arguments.json ? json : summaryOf(result), "");
  return kAnswered;
}

void addOptions(CLI::App& command, ReconstructArguments& arguments) {
  ReconstructionRequest& request = arguments.request;
  command.add_option("CLOUD", arguments.cloud, "Point cloud, PCD or PLY")->required();
  command.add_option("--output", arguments.output, "Mesh file (OBJ); STEM-obstacle.obj beside it")
      ->required();
  command.add_option("--report", arguments.report,
                     "Errors and decisions (JSON); default STEM.json");
  command.add_option("--sensor", arguments.sensor, "Noise of the sensor")
      ->check(CLI::IsMember(sensorModelNames()));
  command.add_option("--focal-length", request.focal_length, "Of the sensor, pixels");
  command.add_option("--crop", arguments.crop, "x,y,z,X,Y,Z: only what is in this box, metres");
  command.add_flag("--remove-plane", request.remove_plane, "Leave out the largest plane: a table");
  command.add_option("--plane-tolerance", request.plane_tolerance, "Its thickness, metres");
  command.add_option("--least-points", request.least_points, "Smaller surfaces are outliers");
  command.add_option("--window", request.window, "Pixels around one that it is averaged with");
  command.add_option("--simplification", request.simplification,
                     "Allowed deviation, metres; default a tenth of the band");
  command.add_option("--unseen", arguments.unseen, "What is made of space that was not seen")
      ->check(CLI::IsMember({"free", "occupied", "report"}));
  command.add_option("--shadow-depth", request.shadow_depth, "How far a shadow reaches, metres");
  command.add_option("--coverage", request.coverage, "With which the band holds everywhere");
  command.add_option("--meshing", arguments.meshing, "Of clouds that are no image")
      ->check(CLI::IsMember({"greedy", "poisson"}));
  auto* sigma =
      command.add_option("--camera-sigma", arguments.pose_sigma,
                         "Deviations x,y,z,rx,ry,rz of the sensor's pose: metres, radians");
  command
      .add_option("--camera-covariance", arguments.pose_covariance,
                  "Its covariance row by row: 36 numbers, or the upper triangle's 21")
      ->excludes(sigma);
  command.add_flag("--json", arguments.json, "Print the report instead of a summary");
}

}  // namespace

void addReconstructCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ReconstructArguments>();
  CLI::App& command =
      *app.add_subcommand("reconstruct", "A point cloud to meshes and their errors");
  addOptions(command, *arguments);
  command.callback([arguments, &exit_code] { exit_code = runReconstruct(*arguments); });
}

}  // namespace fcl_prob::cli
