// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <cmath>
#include <filesystem>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "io/file_content.h"
#include "io/quantities.h"
#include "io/strict_json.h"
#include "io/text_reader.h"

namespace fcl_prob {
namespace {

using NamedWaypoints = std::vector<std::map<std::string, double>>;

constexpr std::size_t kMostCsvBytes = std::size_t{64} << 20;

std::vector<std::string> columnsOf(const std::string& line) {
  std::vector<std::string> columns;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    columns.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return columns;
}

std::map<std::string, double> rowOf(const std::vector<std::string>& joints,
                                    const std::string& line) {
  const std::vector<double> numbers = detail::numberList(line);
  if (numbers.size() != joints.size()) {
    throw InvalidRequest(std::to_string(numbers.size()) + " values for " +
                         std::to_string(joints.size()) + " joints");
  }
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!std::isfinite(numbers[i])) throw InvalidRequest(joints[i] + " is not finite");
    if (!values.emplace(joints[i], numbers[i]).second) {
      throw InvalidRequest("two columns of the joint " + joints[i]);
    }
  }
  return values;
}

NamedWaypoints readCsv(const std::string& path) {
  const std::string text = detail::fileContent(path, kMostCsvBytes);
  detail::LineReader lines(text);
  const auto first = lines.next();
  if (!first) throw FileError(path + ": is empty");
  const std::vector<std::string> joints = columnsOf(std::string(*first));
  NamedWaypoints waypoints;
  while (const auto line = lines.next()) {
    if (line->empty()) continue;
    try {
      waypoints.push_back(rowOf(joints, std::string(*line)));
    } catch (const InvalidRequest& error) {
      throw FileError(path + ": line " + std::to_string(lines.lineNumber()) + ": " + error.what());
    }
  }
  return waypoints;
}

struct Motion {
  NamedWaypoints waypoints;
  std::optional<double> largest_step;
};

Motion readJson(const std::string& path) {
  const nlohmann::json document = detail::parseJsonFile(path);
  detail::StrictObject root(document, path);
  Motion motion;
  for (const detail::StrictObject& waypoint : root.objects("waypoints")) {
    motion.waypoints.push_back(waypoint.numbersByName());
  }
  if (root.has("largest_step")) motion.largest_step = root.number("largest_step");
  if (motion.largest_step && !(*motion.largest_step > 0.0)) {
    root.fail("largest_step", "must be > 0");
  }
  return motion;
}

Motion readMotion(const std::string& path) {
  Motion motion = std::filesystem::path(path).extension() == ".csv" ? Motion{readCsv(path), {}}
                                                                    : readJson(path);
  if (motion.waypoints.empty()) throw FileError(path + ": waypoints: there are none");
  return motion;
}

}  // namespace

NamedWaypoints loadWaypoints(const std::string& path) { return readMotion(path).waypoints; }

void loadMotion(const std::string& path, RobotScene& scene) {
  Motion motion = readMotion(path);
  scene.waypoints = std::move(motion.waypoints);
  if (!scene.largest_step) scene.largest_step = motion.largest_step;
}

}  // namespace fcl_prob
