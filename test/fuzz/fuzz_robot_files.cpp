// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Robots: a URDF, and after the first byte that is 0 an SRDF. Those that load have a place for each
// body, and some are asked how likely they are to touch a ball.
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <cstddef>
#include <random>
#include <set>
#include <string_view>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_groups.h"
#include "fcl_prob/robot_query.h"
#include "fcl_prob/self_collision.h"
#include "fuzz_tally.h"
#include "memory_file.h"

using namespace fcl_prob;
using namespace fcl_prob_fuzz;

namespace {

/// No text may have it, so that it ends the URDF.
constexpr char kSeparator = '\0';

/// What takes much longer than to load a robot: to look for a mesh, in a process of its own, and P.
constexpr std::uint64_t kMeshOneIn = 16;
constexpr std::uint64_t kAnswerOneIn = 4;

bool namesMesh(std::string_view text) { return text.find("mesh") != std::string_view::npos; }

/// What `read` makes of a file with this text; nothing if it refuses it.
template <typename Read>
auto readFrom(const MemoryFile& file, std::string_view text, const Read& read) {
  file.write(text.data(), text.size());
  std::optional<decltype(read(file.path()))> result;
  try {
    result.emplace(read(file.path()));
  } catch (const Exception& error) {
    // A mesh has a file of its own.
    require(boost::starts_with(error.what(), file.path()) || namesMesh(text),
            "a message without the file's name");
  }
  return result;
}

std::optional<Robot> robotOf(std::string_view urdf) {
  static const MemoryFile file(".urdf");
  return readFrom(file, urdf, [](const std::string& path) { return Robot(path); });
}

std::optional<std::vector<LinkPair>> allowedPairsOf(std::string_view srdf, const Robot& robot) {
  static const MemoryFile file(".srdf");
  return readFrom(file, srdf,
                  [&](const std::string& path) { return loadAllowedPairs(path, robot); });
}

std::optional<RobotGroups> groupsOf(std::string_view srdf, const Robot& robot) {
  static const MemoryFile file(".groups.srdf");
  return readFrom(file, srdf, [&](const std::string& path) { return loadGroups(path, robot); });
}

void requireWellFormed(const Robot& robot) {
  require(!robot.bodies().empty(), "a robot without bodies");
  const std::vector<RobotLink>& links = robot.links();
  std::set<std::string> names;
  for (std::size_t i = 0; i < links.size(); ++i) {
    require(names.insert(links[i].name).second, "two links of one name");
    const bool is_root = i == 0;
    require(is_root == (links[i].parent < 0) && links[i].parent < static_cast<int>(i),
            "a link before the one that carries it");
  }
  for (const RobotBody& body : robot.bodies()) {
    require(names.count(body.link) == 1, "a body of no link");
  }
  names.clear();
  for (const RobotJoint& joint : robot.joints()) {
    require(names.insert(joint.name).second, "two joints of one name");
    require(joint.lower <= joint.upper, "limits the wrong way round");
  }
}

/// At 0, or the limits nearest to it.
void requirePlaced(const Robot& robot) {
  const Eigen::VectorXd values = robot.values({});
  robot.validate(values);
  require(robot.isWithinLimits(values), "a state beyond its limits");
  const std::vector<fcl::Transform3d> poses = robot.poses(values);
  require(poses.size() == robot.bodies().size(), "bodies without a pose");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    require(poses[i].matrix().allFinite(), "a pose that is not finite");
    const Eigen::Matrix3d product = poses[i].linear().transpose() * poses[i].linear();
    require(product.isIdentity(1e-6), "a pose that is no rotation");
    for (const CarryingJoint& joint : robot.carryingJoints(i, values)) {
      require(joint.joint < robot.joints().size(), "a joint that is not there");
    }
  }
}

void requireProbability(const Robot& robot) {
  ProbabilityRequest request;
  request.max_cells = 32;
  const auto ball = std::make_shared<fcl::Sphered>(0.1);
  ball->computeLocalAABB();
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const RobotQuery query(robot, {{"ball", ball, fcl::Transform3d::Identity(), displacement}});
  const Bounds any = query.state(robot.values({}), request).any;
  require(0.0 <= any.lower && any.lower <= any.upper && any.upper <= 1.0, "no probability");
}

void requireFewerPairs(const Robot& robot, const std::vector<LinkPair>& allowed) {
  const std::size_t all = SelfCollision(robot).pairs().size();
  require(SelfCollision(robot, allowed).pairs().size() <= all, "pairs from what is allowed");
}

void requireStates(const Robot& robot, const RobotGroups& groups) {
  for (const auto& [name, group] : groups) {
    require(group.joints.size() <= group.links.size(), "a joint that carries no link");
    for (const auto& [state, values] : group.states) robot.values(values);
  }
}

/// Whether it is not refused, as sizes and places near the largest double may be.
template <typename Ask>
bool answers(const Ask& ask) {
  try {
    ask();
    return true;
  } catch (const Exception&) {
    return false;
  }
}

void lookAt(const Robot& robot, std::string_view srdf, std::uint64_t hash, Tally& tally) {
  requireWellFormed(robot);
  if (!answers([&] { requirePlaced(robot); })) return;
  tally.count("placed");
  if (hash % kAnswerOneIn == 0 && answers([&] { requireProbability(robot); })) {
    tally.count("answered");
  }
  const auto allowed = allowedPairsOf(srdf, robot);
  if (allowed && answers([&] { requireFewerPairs(robot, *allowed); })) {
    tally.count("with links that may touch");
  }
  const auto groups = groupsOf(srdf, robot);
  if (groups) requireStates(robot, *groups);
  if (groups && !groups->empty()) tally.count("with groups");
}

using Random = std::minstd_rand;
using Texts = std::vector<std::string>;

const std::string& oneOf(const Texts& texts, Random& random) {
  return texts[random() % texts.size()];
}

std::string nameOf(const char* kind, std::size_t number) { return kind + std::to_string(number); }

std::string anyLink(std::size_t number, Random& random) {
  static const Texts shapes = {"<box size=\"0.1 0.2 0.3\"/>", "<sphere radius=\"0.1\"/>",
                               "<cylinder radius=\"0.1\" length=\"0.2\"/>",
                               "<mesh filename=\"none.stl\" scale=\"1 -1 1\"/>"};
  std::string text = "<link name=\"" + nameOf("l", number) + "\">";
  // Few have a mesh: the input is then passed over most often.
  const std::string& shape = random() % 16 == 0 ? shapes.back() : shapes[random() % 3];
  if (number == 0 || random() % 4 != 0) {
    text += "<collision><origin xyz=\"0 0 0.1\" rpy=\"0.1 0 0\"/><geometry>" + shape +
            "</geometry></collision>";
  }
  return text + "</link>";
}

std::string anyJoint(std::size_t child, std::size_t links, Random& random) {
  static const Texts kinds = {"fixed", "revolute", "continuous", "prismatic"};
  static const Texts axes = {"", "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"1 2 -3\"/>"};
  std::string text = "<joint name=\"" + nameOf("j", child) + "\" type=\"" + oneOf(kinds, random) +
                     "\"><parent link=\"" + nameOf("l", random() % child) + "\"/><child link=\"" +
                     nameOf("l", child) + "\"/><origin xyz=\"0 0 0.2\" rpy=\"0 0.2 0\"/>" +
                     oneOf(axes, random) +
                     "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
  if (random() % 3 == 0) {
    text += "<mimic joint=\"" + nameOf("j", 1 + random() % (links - 1)) +
            "\" multiplier=\"-2\" offset=\"0.1\"/>";
  }
  return text + "</joint>";
}

std::string anySrdf(std::size_t links, Random& random) {
  static const Texts tags = {"disable_collisions", "enable_collisions",
                             "disable_default_collisions"};
  std::string text = "<robot name=\"r\">";
  for (std::size_t count = random() % 4; count > 0; --count) {
    text += "<" + oneOf(tags, random);
    for (const char* attribute : {"link", "link1", "link2"}) {
      text += std::string(" ") + attribute + "=\"" + nameOf("l", random() % links) + "\"";
    }
    text += "/>";
  }
  for (std::size_t count = random() % 3; count > 0; --count) {
    text += "<group name=\"" + nameOf("g", count) + "\"><joint name=\"" +
            nameOf("j", random() % links) + "\"/>" +
            (random() % 2 == 0 ? "<group name=\"" + nameOf("g", random() % 3) + "\"/>" : "") +
            "<chain base_link=\"" + nameOf("l", random() % links) + "\" tip_link=\"" +
            nameOf("l", random() % links) + "\"/></group><group_state name=\"s\" group=\"" +
            nameOf("g", random() % 3) + "\"><joint name=\"" + nameOf("j", random() % links) +
            "\" value=\"0.1\"/></group_state>";
  }
  return text + "</robot>";
}

/// To be changed half of the time: most of what a fuzzer has come by is no robot any more.
std::string anyRobot(Random& random) {
  const std::size_t links = 1 + random() % 6;
  std::string text = "<robot name=\"r\">";
  for (std::size_t i = 0; i < links; ++i) text += anyLink(i, random);
  for (std::size_t i = 1; i < links; ++i) text += anyJoint(i, links, random);
  return text + "</robot>" + kSeparator + anySrdf(links, random);
}

/// Puts another value between two quotes, so that what was a robot mostly still is one.
std::string changed(const std::string& text, Random& random) {
  static const Texts others = {
      "0",      "1",         "-1",    "1e-9",     "1e9",        "1e-160",   "1e160",
      "1e-320", "1e308",     "%n%s",  "nan",      "inf",        "1 0 0",    "0 0 0",
      "1 2 3",  "1e200 0 0", "fixed", "revolute", "continuous", "floating", "prismatic"};
  std::vector<std::size_t> quotes;
  for (std::size_t i = text.find('"'); i < text.size(); i = text.find('"', i + 1)) {
    quotes.push_back(i);
  }
  if (quotes.size() < 2) return text;
  const auto valueAt = [&](std::size_t pair) {
    return text.substr(quotes[2 * pair] + 1, quotes[2 * pair + 1] - quotes[2 * pair] - 1);
  };
  const std::size_t pairs = quotes.size() / 2, at = random() % pairs;
  // Names of other links and joints above all.
  const std::string value = random() % 2 == 0 ? valueAt(random() % pairs) : oneOf(others, random);
  return text.substr(0, quotes[2 * at] + 1) + value + text.substr(quotes[2 * at + 1]);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  Random random(seed);
  if (random() % 4 != 0) {
    const bool is_new = random() % 2 == 0;
    std::string text =
        is_new ? anyRobot(random) : std::string(reinterpret_cast<const char*>(data), size);
    for (std::size_t changes = random() % 4; changes > 0; --changes) {
      text = changed(text, random);
    }
    if (text.size() <= max_size) return text.copy(reinterpret_cast<char*>(data), text.size());
  }
  return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Tally tally("robot files");
  tally.count("inputs");
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  const std::uint64_t hash = hashOf(data, size);
  const std::size_t end = std::min(content.find(kSeparator), size);
  const std::string_view urdf = content.substr(0, end);
  if (namesMesh(urdf) && hash % kMeshOneIn != 0) return 0;
  const std::optional<Robot> robot = robotOf(urdf);
  if (!robot) return 0;
  tally.count("robots");
  lookAt(*robot, content.substr(std::min(end + 1, size)), hash, tally);
  return 0;
}
