// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The judge of estimates and decisions over poses and joints as a program (docs/pose.md).
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "judge_report.h"

using namespace fcl_prob_judge;

namespace {

constexpr const char* kUsage = R"(usage: pose_judge [options]
  --scene NAME,…|all|known|drawn   part of a name is enough   (all)
  --scene-seed K                   of the drawn scenes        (1)
  --seeds N  --first-seed K        queries a question         (20, 1)
  --mode decide|estimate|both                                 (both)
  --method auto|estimate|rare-event|monte-carlo               (auto)
  --factors F,…                    thresholds over P          (0.5,0.97,1.03,2)
  --confidences C,…                                           (0.9999,0.99)
  --tolerance T                    relative                   (0.01)
  --time-limit S                   a query                    (1; 0 for none)
  --max-cells N                    a query
  --budget S                       of the run: no seed is begun after it
  --threads N                                                 (1)
  --output FILE                    one line of JSON a query
  --read FILE,…                    judges what was written before and asks nothing
  --list                           names and P's of the scenes, and how their turns matter
Exit code 1 if something does not hold.
)";

struct Arguments {
  JudgePlan plan;
  std::vector<std::string> scenes{"all"};
  std::vector<std::string> read;
  std::string output;
  unsigned scene_seed = 1;
  bool list = false;
};

std::vector<std::string> parts(const std::string& list) {
  std::vector<std::string> result;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) result.push_back(part);
  return result;
}

std::vector<double> numbers(const std::string& list) {
  std::vector<double> result;
  for (const std::string& part : parts(list)) result.push_back(std::stod(part));
  return result;
}

std::vector<Mode> modesFrom(const std::string& name) {
  if (name == "decide") return {Mode::decide};
  if (name == "estimate") return {Mode::estimate};
  if (name == "both") return {Mode::decide, Mode::estimate};
  throw std::invalid_argument("no mode " + name);
}

bool setOfPlan(JudgePlan& plan, const std::string& option, const std::string& value) {
  if (option == "--seeds") {
    plan.seeds = std::stoull(value);
  } else if (option == "--first-seed") {
    plan.first_seed = std::stoull(value);
  } else if (option == "--mode") {
    plan.modes = modesFrom(value);
  } else if (option == "--method") {
    const auto method = fcl_prob::methodFromString(value);
    if (!method) throw std::invalid_argument("no method " + value);
    plan.method = *method;
  } else if (option == "--factors") {
    plan.factors = numbers(value);
  } else if (option == "--confidences") {
    plan.confidences = numbers(value);
  } else if (option == "--tolerance") {
    plan.relative_tolerance = std::stod(value);
  } else if (option == "--time-limit") {
    plan.time_limit = std::stod(value);
    if (*plan.time_limit == 0.0) plan.time_limit.reset();
  } else if (option == "--max-cells") {
    plan.max_cells = std::stoull(value);
  } else if (option == "--budget") {
    plan.budget = std::stod(value);
  } else if (option == "--threads") {
    plan.threads = static_cast<unsigned>(std::stoul(value));
  } else {
    return false;
  }
  return true;
}

Arguments parsed(int argc, char** argv) {
  Arguments arguments;
  arguments.plan.time_limit = 1.0;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--list") {
      arguments.list = true;
      continue;
    }
    if (i + 1 >= argc) throw std::invalid_argument(option + " needs a value, or is no option");
    const std::string value = argv[++i];
    if (setOfPlan(arguments.plan, option, value)) continue;
    if (option == "--scene") {
      arguments.scenes = parts(value);
    } else if (option == "--scene-seed") {
      arguments.scene_seed = static_cast<unsigned>(std::stoul(value));
    } else if (option == "--output") {
      arguments.output = value;
    } else if (option == "--read") {
      arguments.read = parts(value);
    } else {
      throw std::invalid_argument("no option " + option);
    }
  }
  return arguments;
}

/// Whether a drawn scene may be one of `names`, before its truth is found: of all that takes a
/// minute.
bool mayBeAmong(const std::vector<std::string>& names, int index) {
  const std::string number = "drawn_" + std::string(index < 10 ? "0" : "") + std::to_string(index);
  for (const std::string& name : names) {
    if (name == "known") continue;
    const bool other = name.rfind("drawn_", 0) == 0 && name.rfind(number, 0) != 0;
    if (!other) return true;
  }
  return false;
}

std::vector<AskableScene> scenesOf(const Arguments& arguments) {
  const auto wanted = [&](const JudgedScene& scene, const std::string& group) {
    for (const std::string& name : arguments.scenes) {
      if (name == "all" || name == group || scene.name.find(name) != std::string::npos) return true;
    }
    return false;
  };
  std::vector<AskableScene> scenes;
  for (JudgedScene& scene : knownScenes()) {
    if (wanted(scene, "known")) scenes.emplace_back(std::move(scene));
  }
  for (int index = 0; index < kDrawnScenes; ++index) {
    if (!mayBeAmong(arguments.scenes, index)) continue;
    JudgedScene scene = drawnScene(arguments.scene_seed, index);
    if (wanted(scene, "drawn")) scenes.emplace_back(std::move(scene));
  }
  return scenes;
}

JudgeReport readAnswers(const std::vector<std::string>& names) {
  JudgeReport report;
  for (const std::string& name : names) {
    std::ifstream file(name);
    if (!file) throw std::runtime_error("cannot read " + name);
    for (std::string line; std::getline(file, line);) report.add(answerFromJson(line));
  }
  return report;
}

JudgeReport askAll(const Arguments& arguments, const std::vector<AskableScene>& scenes) {
  JudgeReport report;
  std::ofstream file;
  if (!arguments.output.empty()) {
    file.open(arguments.output);
    if (!file) throw std::runtime_error("cannot write " + arguments.output);
  }
  runJudge(arguments.plan, scenes, [&](const Answer& answer) {
    report.add(answer);
    if (file.is_open()) file << jsonOf(answer) << "\n" << std::flush;
  });
  return report;
}

void tellScenes(const std::vector<AskableScene>& scenes) {
  std::cout.precision(12);
  for (const AskableScene& askable : scenes) {
    const JudgedScene& scene = askable.scene();
    std::cout << scene.name << "  P " << scene.truth;
    for (const Component& component : scene.components) {
      std::cout << "; weight " << component.weight << ", " << component.truth.dimension
                << " normals, contact within " << component.truth.feature << " of their deviations"
                << (component.truth.smooth ? "" : ", not smooth");
    }
    std::cout << "\n";
  }
}

int run(const Arguments& arguments) {
  if (!arguments.read.empty()) {
    const JudgeReport report = readAnswers(arguments.read);
    std::cout << report.text();
    return report.hasFaults() ? 1 : 0;
  }
  const std::vector<AskableScene> scenes = scenesOf(arguments);
  if (scenes.empty()) throw std::invalid_argument("no such scene");
  if (arguments.list) {
    tellScenes(scenes);
    return 0;
  }
  const JudgeReport report = askAll(arguments, scenes);
  std::cout << report.text();
  return report.hasFaults() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--help") {
    std::cout << kUsage;
    return 0;
  }
  try {
    return run(parsed(argc, argv));
  } catch (const std::exception& exception) {
    std::cerr << "pose_judge: " << exception.what() << " (--help tells the options)\n";
    return 2;
  }
}
