// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/commands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "base/stopwatch.h"
#include "cli/number_text.h"
#include "cli/output.h"
#include "cli/run.h"
#include "fcl_prob/convex_parts.h"
#include "fcl_prob/mesh_io.h"

namespace fcl_prob::cli {
namespace {

constexpr int kAllDigits = 17;

struct DecomposeArguments {
  std::string mesh;
  MeshOptions options;
  DecompositionRequest request;
  std::string output;
};

std::string summaryOf(const ConvexParts& parts, const TriangleMesh& mesh, double time_ms) {
  double volume = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) volume += parts.volume(i);
  return std::to_string(mesh.triangles.size()) + " triangles in " + std::to_string(parts.size()) +
         " convex part" + (parts.size() == 1 ? "" : "s") + " of " + numberText(volume, 4) +
         " m^3 in all, " + numberText(time_ms, 4) + " ms\n";
}

/// The parts as a Wavefront file, one object a part, with all digits.
std::string objOf(const ConvexParts& parts) {
  std::ostringstream text;
  text << std::setprecision(kAllDigits);
  std::size_t first = 1;  // vertices are counted through the whole file, from 1
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ConvexPolytope& part = parts.polytope(i);
    text << "o part_" << i + 1 << '\n';
    for (const Eigen::Vector3d& v : part.vertices) {
      text << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    for (const ConvexPolytope::Face& face : part.faces) {
      text << 'f';
      for (const int vertex : face.vertices)
        text << ' ' << first + static_cast<std::size_t>(vertex);
      text << '\n';
    }
    first += part.vertices.size();
  }
  return text.str();
}

int runDecompose(const DecomposeArguments& arguments) {
  const TriangleMesh mesh = loadMeshIsolated(arguments.mesh, arguments.options);
  const detail::Stopwatch watch;
  DecompositionRequest request = arguments.request;
  request.pieces = std::max(request.pieces, request.max_parts);
  const ConvexParts parts(mesh, request);
  const double time_ms = watch.milliseconds();
  writeFile(arguments.output, objOf(parts));
  deliver(summaryOf(parts, mesh, time_ms), "");
  return kAnswered;
}

}  // namespace

void addDecomposeCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<DecomposeArguments>();
  CLI::App& command =
      *app.add_subcommand("decompose", "Convex parts that cover a mesh, as one file");
  command.add_option("MESH", arguments->mesh, "Mesh file")->required();
  command.add_option("--output", arguments->output, "Wavefront file (OBJ), one object a part")
      ->required();
  command.add_flag("--normalize", arguments->options.normalize,
                   "Centre the mesh and make its longest side 1 m, before the scale");
  command.add_option("--scale", arguments->options.scale, "Factor on the coordinates");
  command.add_option("--parts", arguments->request.max_parts, "Parts at most")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--concavity", arguments->request.concavity,
                  "Of the volume of the mesh's hull: what uniting two parts may add")
      ->capture_default_str();
  command
      .add_option("--pieces", arguments->request.pieces,
                  "Pieces that parts are put together from: more take longer and fit better")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.callback([arguments, &exit_code] { exit_code = runDecompose(*arguments); });
}

}  // namespace fcl_prob::cli
