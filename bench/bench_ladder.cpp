// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench ladder: which rungs answer, and what queries take without each of them.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <octomap/octomap.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <utility>

#include "base/left_out.h"
#include "base/stopwatch.h"
#include "bench/bench_scenes.h"
#include "bench/bench_task.h"
#include "bench/benchmark.h"
#include "bench/mixed_scenes.h"
#include "bench/part_scenes.h"
#include "cli/number_text.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mesh_io.h"
#ifdef FCL_PROB_HAS_ROBOT
#include "bench/random_states.h"
#endif

namespace fcl_prob::cli {
namespace {

constexpr double kMostSecondsOfRung = 1.0;

// What takes longer is asked once.
constexpr double kOnce = 0.1;
constexpr std::size_t kMixedScenes = 30;
constexpr std::size_t kShapePairs = 40;
constexpr std::size_t kPartScenes = 21;  // beside an arm, and beside a tray
constexpr double kTrayLength = 0.4;
constexpr int kPartsOfGroup = 3;
constexpr double kVoxel = 0.02;

/// Of each robot, of those that have P between these two.
constexpr int kStatesOfLadder = 10;
constexpr Bounds kUncertain{1e-4, 0.9};

using Ask = std::function<ProbabilityResult(const ProbabilityRequest&)>;

/// A scene, which is prepared anew for everything that is left out.
struct LadderScene {
  std::string group;
  std::function<Ask()> prepare;
};

/// Rungs, and mechanisms inside of them, by the names that detail::isLeftOut() is asked for.
const std::vector<std::string>& whatCanBeLeftOut() {
  static const std::vector<std::string> all{
      "root volumes",      "convex meshes",  "exact mass",         "lines",
      "columns",           "polytope cells", "nearly convex",      "layers of nodes",
      "curved boundaries", "parts of cells", "layers by topology", "closest approach",
      "polygons"};
  return all;
}

/// Columns of the table.
const std::vector<std::string>& groups() {
  static const std::vector<std::string> all{"statues", "dense",  "mixed",  "parts", "trays",
                                            "octrees", "groups", "states", "shapes"};
  return all;
}

const std::vector<BenchTask>& ladderTasks() {
  static const std::vector<BenchTask> all{intervalTask(0.1), intervalTask(0.01), estimateTask(0.01),
                                          decisionTask(0.05)};
  return all;
}

Ask askOf(std::shared_ptr<PreparedScene> scene) {
  return [scene = std::move(scene)](const ProbabilityRequest& request) {
    return scene->query(request).result;
  };
}

/// Of a scene that was drawn, prepared once more.
Ask askAnew(const PreparedScene& drawn) {
  return askOf(std::make_shared<PreparedScene>(drawn.objectA(), drawn.objectB(),
                                               drawn.displacement(), "obbrss"));
}

void addStatues(const std::string& group, const std::vector<BenchScene>& statues,
                const BenchOptions& options, std::vector<LadderScene>& scenes) {
  for (const BenchScene& scene : statues) {
    scenes.push_back({group, [scene, folder = options.models_folder] {
                        return askOf(std::make_shared<PreparedScene>(
                            prepareBenchScene(scene, folder, "obbrss")));
                      }});
  }
}

void addMixedScenes(const BenchOptions& options, std::vector<LadderScene>& scenes) {
  MixedScenes mixed(options.models_folder, options.seed);
  const std::size_t count = options.quick ? kMixedScenes / 5 : kMixedScenes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::shared_ptr<PreparedScene> drawn = mixed.next().scene;
    scenes.push_back({"mixed", [drawn] { return askAnew(*drawn); }});
  }
}

/// A tray with flat sides, as CAD has them, 0.4 m long.
TriangleMesh trayMesh(const std::string& models_folder) {
  const std::filesystem::path models(models_folder);
  TriangleMesh tray = loadMeshIsolated((models / "cad/1002_tray_bottom.STL").string());
  const double scale = kTrayLength / longestSide(tray);
  for (Eigen::Vector3d& vertex : tray.vertices) vertex *= scale;
  return tray;
}

// Every other one as solids, if the other body is closed.
void addPartScenes(const BenchOptions& options, const std::string& group, TriangleMesh beside,
                   std::vector<LadderScene>& scenes) {
  PartScenes parts(options.models_folder, options.seed, std::move(beside));
  const std::size_t names = PartScenes::names().size();
  const std::size_t count = options.quick ? names : kPartScenes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::shared_ptr<PreparedScene> drawn = parts.next(i % names).scene;
    scenes.push_back({group, [drawn, is_solid = group == "parts" && i % 2 == 1] {
                        const Ask ask = askAnew(*drawn);
                        return Ask([=](ProbabilityRequest request) {
                          if (is_solid) request.contact = ContactMeaning::solid;
                          return ask(request);
                        });
                      }});
  }
}

/// What a sensor makes of a mesh: occupied cells where it has vertices.
Geometry octreeOf(const TriangleMesh& mesh) {
  const auto tree = std::make_shared<octomap::OcTree>(kVoxel);
  for (const Eigen::Vector3d& v : mesh.vertices) {
    tree->updateNode(octomap::point3d(static_cast<float>(v[0]), static_cast<float>(v[1]),
                                      static_cast<float>(v[2])),
                     true);
  }
  return std::make_shared<fcl::OcTreed>(tree);
}

// A part beside the cells of an arm in an octree, and three of them as one body beside the arm.
void addOctreesAndGroups(const BenchOptions& options, std::vector<LadderScene>& scenes) {
  const TriangleMesh arm = armMesh(options.models_folder);
  const Geometry cells = octreeOf(arm);
  const std::size_t names = PartScenes::names().size();
  PartScenes parts(options.models_folder, options.seed, arm);
  GroupQuery::Geometries of_group;
  std::vector<fcl::Transform3d> poses;
  for (std::size_t i = 0; i < kPartsOfGroup * names; ++i) {
    const auto drawn = parts.next(i % names).scene;
    const Geometry part = buildGeometry(drawn->objectA(), "obbrss");
    const std::vector<fcl::Transform3d> pose_a{drawn->objectA().pose};
    const std::vector<fcl::Transform3d> pose_b{drawn->objectB().pose};
    const GaussianDisplacement error = drawn->displacement();
    const auto add = [&](const std::string& group, const GroupQuery::Geometries& a,
                         const std::vector<fcl::Transform3d>& poses_a, const Geometry& b) {
      scenes.push_back({group, [=] {
                          const auto query =
                              std::make_shared<GroupQuery>(a, GroupQuery::Geometries{b});
                          return Ask([=](const ProbabilityRequest& request) {
                            ProbabilityResult result;
                            query->collisionProbability(poses_a, pose_b, error, request, result);
                            return result;
                          });
                        }});
    };
    of_group.push_back(part);
    poses.push_back(pose_a[0]);
    if (of_group.size() < kPartsOfGroup) continue;
    add("octrees", {part}, pose_a, cells);
    add("groups", of_group, poses, buildGeometry(drawn->objectB(), "obbrss"));
    of_group.clear();
    poses.clear();
  }
}

#ifdef FCL_PROB_HAS_ROBOT
Ask askOf(const Robot& robot, const Obstacle& person, const Eigen::VectorXd& values) {
  const auto query = std::make_shared<RobotQuery>(robot, std::vector<Obstacle>{person});
  return [query, values](const ProbabilityRequest& request) {
    const RobotResult all = query->state(values, request);
    ProbabilityResult result;
    result.status = all.status;
    if (!all.parts.empty()) result.statistics = all.parts[0].statistics;
    return result;
  };
}

// Random states, each beside a person of its own, whose P may lie within kUncertain as far as a
// rough interval tells.
void addRobotStates(const BenchOptions& options, std::vector<LadderScene>& scenes) {
  const Geometry mesh = personMesh(options.models_folder);
  ProbabilityRequest rough;
  rough.method = ProbabilityMethod::interval;
  rough.relative_tolerance = 0.5;
  for (const char* name : {"KUKA iiwa", "Fetch"}) {
    Uniforms random(options.seed);
    const Robot robot = benchRobot(options.models_folder, name);
    const RobotQuery query(robot, {personBeside(mesh, random)});
    for (int found = 0; found < (options.quick ? kStatesOfLadder / 5 : kStatesOfLadder);) {
      const Obstacle person = personBeside(mesh, random);
      const Eigen::VectorXd values = drawnStates(robot, random, 1);
      const Bounds p = query.withObstacles({person}).state(values, rough).any;
      if (p.upper < kUncertain.lower || p.lower > kUncertain.upper) continue;
      ++found;
      scenes.push_back({"states", [=] { return askOf(robot, person, values); }});
    }
  }
}
#endif

Geometry randomShape(Uniforms& random) {
  const auto size = [&random] { return random.logBetween(0.02, 0.2); };
  switch (random.below(6)) {
    case 0:
      return std::make_shared<fcl::Boxd>(size(), size(), size());
    case 1:
      return std::make_shared<fcl::Sphered>(size());
    case 2:
      return std::make_shared<fcl::Capsuled>(size(), size());
    case 3:
      return std::make_shared<fcl::Cylinderd>(size(), size());
    case 4:
      return std::make_shared<fcl::Coned>(size(), size());
    default:
      return std::make_shared<fcl::Ellipsoidd>(size(), size(), size());
  }
}

// Half of them move in a plane only.
void addShapePairs(const BenchOptions& options, std::vector<LadderScene>& scenes) {
  Uniforms random(options.seed);
  for (std::size_t i = 0; i < kShapePairs; ++i) {
    const auto query = std::make_shared<PreparedQuery>(randomShape(random), randomShape(random));
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.linear() = random.rotation();
    pose.translation() = random.rotation().col(0) * random.between(0.05, 0.3);
    Eigen::Vector3d deviations;
    for (int k = 0; k < 3; ++k) deviations[k] = random.logBetween(0.01, 0.05);
    if (i % 2 == 1) deviations[2] = 0.0;
    const auto error = GaussianDisplacement::fromStandardDeviations(
        deviations, Eigen::Quaterniond(random.rotation()));
    scenes.push_back({"shapes", [query, pose, error] {
                        return Ask([=](const ProbabilityRequest& request) {
                          ProbabilityResult result;
                          query->collisionProbability(fcl::Transform3d::Identity(), pose, error,
                                                      request, result);
                          return result;
                        });
                      }});
  }
}

struct Asked {
  ProbabilityResult result;
  double seconds;
};

/// All tasks of a scene, the quickest of three runs; one before them prepares what a task needs.
std::vector<Asked> askAll(const LadderScene& scene, const BenchOptions& options) {
  const Ask ask = scene.prepare();
  std::vector<Asked> all;
  for (const BenchTask& task : ladderTasks()) {
    ProbabilityRequest request = task.request(options.seed);
    if (scene.group == "shapes" && request.method == ProbabilityMethod::interval) {
      request.method = ProbabilityMethod::automatic;
    }
    request.time_limit = kMostSecondsOfRung;
    ask(request);
    Asked best{{}, 1e300};
    for (int run = 0; run < 3 && (run == 0 || best.seconds < kOnce); ++run) {
      const detail::Stopwatch watch;
      ProbabilityResult result = ask(request);
      const double seconds = watch.seconds();
      if (seconds < best.seconds) best = {std::move(result), seconds};
    }
    all.push_back(std::move(best));
  }
  return all;
}

/// How often a rung was climbed and answered, and how long that took.
struct Climbed {
  std::size_t times = 0;
  std::size_t answered = 0;
  double seconds = 0.0;
};

class LadderTable {
 public:
  explicit LadderTable(const BenchOptions& options) : options_(options) {}

  void add(const LadderScene& scene) {
    const std::vector<Asked> with = askAll(scene, options_);
    for (const Asked& asked : with) {
      ++queries_;
      seconds_ += asked.seconds;
      for (const RungRecord& rung : asked.result.statistics.rungs) {
        if (rung.times == 0) continue;  // left out: no row of its own
        Climbed& climbed = rungs_[rung.name];
        climbed.times += rung.times;
        climbed.answered += rung.answered;
        climbed.seconds += rung.seconds;
      }
    }
    for (const std::string& name : whatCanBeLeftOut()) {
      if (name.find(options_.only) == std::string::npos) continue;
      detail::leftOut() = {name};
      const std::vector<Asked> without = askAll(scene, options_);
      detail::leftOut().clear();
      for (std::size_t i = 0; i < with.size(); ++i) {
        const double ratio = without[i].seconds / with[i].seconds;
        ratios_[{name, scene.group}].push_back(ratio);
        ratios_[{name, "all"}].push_back(ratio);
        records_.push_back({{"left_out", name},
                            {"group", scene.group},
                            {"task", ladderTasks()[i].name},
                            {"with_ms", 1e3 * with[i].seconds},
                            {"without_ms", 1e3 * without[i].seconds},
                            {"with", toString(with[i].result.status)},
                            {"without", toString(without[i].result.status)}});
      }
    }
  }

  BenchReport take() {
    BenchReport report;
    report.title = "What each rung, and each mechanism, is worth";
    std::vector<std::string> header{"left out",    "climbed", "answered", "share of time",
                                    "all: median", "mean",    "90 %"};
    for (const std::string& group : groups()) header.push_back(group + ": mean");
    report.table = TextTable(header);
    for (const auto& [name, climbed] : rungs_) {
      const auto listed = std::find(whatCanBeLeftOut().begin(), whatCanBeLeftOut().end(), name);
      if (listed == whatCanBeLeftOut().end()) addRow(name, climbed, report);
    }
    for (const std::string& name : whatCanBeLeftOut()) addRow(name, rungs_[name], report);
    report.notes =
        "Intervals of 10 % and 1 %, estimates of 1 % and decisions at 5 %, 1 s at most, one "
        "thread:\n"
        "the six statues, two of 69,451 and 100,000 triangles (dense), 30 mixed pairs (`bench\n"
        "mixed`), 21 robot parts beside an arm (`bench parts`) and 21 beside a tray of flat "
        "sides,\n"
        "seven of them beside the arm as cells of 2 cm (octrees) and in threes (groups), 10 states "
        "of\n"
        "each robot beside a person whose P is 1e-4 to 0.9, 40 pairs of convex shapes. `climbed`,\n"
        "`answered`: of " +
        std::to_string(queries_) +
        " queries. The other columns: the time without it over that with it,\n"
        "`mean` is geometric.\n";
    report.records = std::move(records_);
    return report;
  }

 private:
  void addRow(const std::string& name, const Climbed& climbed, BenchReport& report) const {
    const auto over = [&](const std::string& group, const auto& value) {
      const auto found = ratios_.find({name, group});
      return found == ratios_.end() ? std::string() : numberText(value(found->second), 3);
    };
    const auto mean = [](const std::vector<double>& ratios) {
      double sum = 0.0;
      for (const double ratio : ratios) sum += std::log(ratio);
      return std::exp(sum / static_cast<double>(ratios.size()));
    };
    const auto at = [](double share) {
      return [share](const std::vector<double>& ratios) { return quantile(ratios, share); };
    };
    const bool is_rung = climbed.times > 0;
    std::vector<std::string> row{name,
                                 is_rung ? std::to_string(climbed.times) : "",
                                 is_rung ? std::to_string(climbed.answered) : "",
                                 is_rung ? numberText(climbed.seconds / seconds_, 2) : "",
                                 over("all", at(0.5)),
                                 over("all", mean),
                                 over("all", at(0.9))};
    for (const std::string& group : groups()) row.push_back(over(group, mean));
    report.table.add(row);
  }

  const BenchOptions& options_;
  std::size_t queries_ = 0;
  double seconds_ = 0.0;
  std::map<std::string, Climbed> rungs_;
  std::map<std::pair<std::string, std::string>, std::vector<double>> ratios_;
  nlohmann::ordered_json records_ = nlohmann::ordered_json::array();
};

}  // namespace

BenchReport benchLadder(const BenchOptions& options, const BenchProgress& progress) {
  std::vector<LadderScene> scenes;
  addStatues("statues", benchScenes(), options, scenes);
  if (!options.quick) addStatues("dense", growthScenes(), options, scenes);
  addMixedScenes(options, scenes);
  addPartScenes(options, "parts", armMesh(options.models_folder), scenes);
  addPartScenes(options, "trays", trayMesh(options.models_folder), scenes);
  if (!options.quick) addOctreesAndGroups(options, scenes);
#ifdef FCL_PROB_HAS_ROBOT
  addRobotStates(options, scenes);
#endif
  addShapePairs(options, scenes);
  LadderTable table(options);
  bool goes_on = true;
  for (std::size_t i = 0; i < scenes.size() && goes_on; ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(scenes.size());
    goes_on = progress(done, scenes[i].group + " " + std::to_string(i + 1));
    if (goes_on) table.add(scenes[i]);
  }
  BenchReport report = table.take();
  report.interrupted = !goes_on;
  return report;
}

}  // namespace fcl_prob::cli
