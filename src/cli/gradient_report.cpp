// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/gradient_report.h"

#include "cli/number_text.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {
namespace {

std::vector<double> rowOf(const Eigen::MatrixXd& matrix, Eigen::Index row) {
  std::vector<double> values;
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) values.push_back(matrix(row, k));
  return values;
}

}  // namespace

JointGradient jointGradient(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints,
                            const RobotScene& scene) {
  if (scene.errors != ErrorsOverTime::persistent || scene.between != BetweenWaypoints::ignored) {
    throw InvalidRequest("a gradient is of waypoints with persistent errors");
  }
  MotionGradientRequest request;
  request.seed = scene.request.seed;
  request.threads = scene.request.threads;
  request.contact = scene.request.contact;
  request.time_limit = scene.request.time_limit;
  request.on_progress = scene.request.on_progress;
  return query.gradient(waypoints, request);
}

nlohmann::ordered_json jsonOf(const JointGradient& gradient, const Robot& robot) {
  nlohmann::ordered_json json{{"probability", gradient.probability},
                              {"standard_error", gradient.standard_error},
                              {"lines", gradient.lines},
                              {"status", toString(gradient.status)}};
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    json["joints"].push_back({{"name", robot.joints()[i].name},
                              {"gradient", rowOf(gradient.gradient, row)},
                              {"standard_error", rowOf(gradient.gradient_standard_error, row)}});
  }
  return json;
}

std::string textOf(const JointGradient& gradient, const Robot& robot) {
  std::string text = "change of P with the joints, summed over the waypoints (" +
                     std::to_string(gradient.lines) + " lines, " + toString(gradient.status) +
                     "):\n";
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const RobotJoint& joint = robot.joints()[i];
    text += "  " + joint.name + ": " + numberText(gradient.gradient.row(row).sum(), 3) + " ± " +
            numberText(gradient.gradient_standard_error.row(row).norm(), 2) +
            (joint.turns ? " 1/rad" : " 1/m") + "\n";
  }
  return text;
}

}  // namespace fcl_prob::cli
