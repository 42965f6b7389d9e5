// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/robot_reproduction.h"

#include <filesystem>
#include <limits>
#include <map>

#include "cli/output.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/mesh_io.h"
#include "fcl_prob/version.h"
#include "io/file_content.h"
#include "io/obj_text.h"
#include "io/scene_parts.h"
#include "robot/mesh_names.h"
#include "robot/motion_names.h"
#include "robot/urdf_model.h"

namespace fcl_prob::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Of a file that was read before, within its own limits.
std::string contentOf(const std::string& path) {
  return detail::fileContent(path, std::numeric_limits<std::size_t>::max());
}

/// The names of meshes in collision elements, as the URDF has them, and where each first stands.
std::map<std::string, std::string> meshNamesOf(const detail::UrdfModel& model) {
  std::map<std::string, std::string> names;
  for (const auto& [name, link] : model.links) {
    for (const detail::UrdfCollision& collision : link.collisions) {
      const auto* mesh = std::get_if<detail::UrdfMesh>(&collision.shape);
      if (mesh != nullptr) names.emplace(mesh->file, collision.where);
    }
  }
  return names;
}

/// Every attribute that is `name`; whether there was one.
bool renameIn(std::string& text, const std::string& name, const std::string& with) {
  bool found = false;
  for (const char quote : {'"', '\''}) {
    const std::string old = quote + name + quote;
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; found = true) {
      text.replace(at, old.size(), quote + with + quote);
    }
  }
  return found;
}

class Reproduction {
 public:
  explicit Reproduction(const fs::path& folder) : folder_(folder) {
    if (fs::exists(folder / "scene.json")) {
      throw FileError((folder / "scene.json").string() + ": is there already");
    }
    fs::create_directories(folder);
  }

  void write(const RobotScene& scene, Json json, const std::string& description) {
    json["description"] = description;
    takeRobot(json["robot"], scene.urdf, scene.robot, "robot");
    if (!scene.srdf.empty()) {
      writeFile((folder_ / "robot.srdf").string(), contentOf(scene.srdf));
      json["robot"]["srdf"] = "robot.srdf";
    }
    for (std::size_t i = 0; i < scene.attached.size(); ++i) {
      takeMesh(json["robot"]["attached"][i], scene.attached[i].object);
    }
    for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
      takeObstacle(json["obstacles"][i], scene.obstacles[i], "obstacle_" + std::to_string(i));
    }
    takeOptions(json, scene);
    writeFile((folder_ / "scene.json").string(), json.dump(1) + "\n");
  }

 private:
  void takeRobot(Json& json, const std::string& urdf, const RobotOptions& options,
                 const std::string& as) const {
    const std::string content = contentOf(urdf);
    std::string text = content;
    std::size_t number = 0;
    for (const auto& [name, where] : meshNamesOf(detail::readUrdf({urdf, content, {}}))) {
      const std::string mesh = as + "_" + std::to_string(number++) + ".obj";
      const std::string source =
          detail::meshFile(name, fs::path(urdf).parent_path().string(), options.packages, where);
      if (!renameIn(text, name, mesh)) {
        throw FileError(where + ": the name of its mesh is written so that it cannot be replaced");
      }
      writeFile((folder_ / mesh).string(), detail::objText(loadMeshIsolated(source), 17));
    }
    writeFile((folder_ / (as + ".urdf")).string(), text);
    json["urdf"] = as + ".urdf";
    json.erase("packages");
  }

  static void takeMesh(Json& json, const SceneObject& object) {
    const auto* mesh = std::get_if<MeshFile>(&object.shape);
    if (mesh == nullptr) return;
    json["mesh"] = detail::meshJson(mesh->read());
    json.erase("scale");
    json.erase("normalize");
  }

  void takeObstacle(Json& json, const RobotScene::PlacedObstacle& obstacle,
                    const std::string& as) const {
    if (obstacle.robot) {
      takeRobot(json["robot"], obstacle.robot->urdf, obstacle.robot->options, as);
    } else if (obstacle.bodies.empty()) {
      takeMesh(json, obstacle.object);
    }
    for (std::size_t i = 0; i < obstacle.bodies.size(); ++i) {
      takeMesh(json["bodies"][i], obstacle.bodies[i]);
    }
  }

  /// What options of the command may have changed.
  static void takeOptions(Json& json, const RobotScene& scene) {
    json["request"] = detail::requestJson(scene.request);
    json["robot"]["allow_outside_limits"] = scene.robot.allow_outside_limits;
    if (scene.largest_step) json["largest_step"] = *scene.largest_step;
    if (scene.plan) {
      json["plan"]["seed"] = scene.plan->seed;
      if (scene.plan->max_states) json["plan"]["max_states"] = *scene.plan->max_states;
      if (scene.plan->motion_threshold) {
        json["plan"]["motion_threshold"] = *scene.plan->motion_threshold;
      }
    }
    if (scene.waypoints.empty()) return;
    json.erase("joints");
    json.erase("plan");
    json["waypoints"] = scene.waypoints;
    json["errors"] = detail::nameOf(detail::kErrorsOverTime, scene.errors);
    json["between"] = detail::nameOf(detail::kBetweenWaypoints, scene.between);
  }

  fs::path folder_;
};

}  // namespace

void writeRobotReproduction(const RobotScene& scene, const std::string& file, const Json& answer,
                            const std::string& folder) {
  Reproduction(folder).write(
      scene, Json::parse(contentOf(file)),
      std::string("fcl_prob ") + FCL_PROB_VERSION + " answered: " + answer.dump());
}

}  // namespace fcl_prob::cli
