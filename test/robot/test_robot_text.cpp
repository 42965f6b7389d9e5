// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Robots from texts, from models that urdfdom has parsed, and from packages that ROS knows, against
// the same robots from files.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <urdf_parser/urdf_parser.h>

#include <cstdlib>
#include <filesystem>

#include "arm_cases.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot.h"
#include "fcl_prob/urdf.h"
#include "models.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// A variable of the environment as long as a test.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~EnvironmentVariable() { ::setenv(name_, before_.c_str(), 1); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  const char* name_;
  std::string before_;
};

/// \param angle  how far poses may be turned against each other, radians, and moved, metres
void checkSameRobot(const Robot& robot, const Robot& truth, double angle, int states = 20) {
  REQUIRE(robot.bodies().size() == truth.bodies().size());
  REQUIRE(robot.joints().size() == truth.joints().size());
  CHECK(robot.name() == truth.name());
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const RobotJoint &x = robot.joints()[i], &y = truth.joints()[i];
    CHECK((x.name == y.name && x.turns == y.turns && x.lower == y.lower && x.upper == y.upper &&
           x.velocity == y.velocity));
  }
  for (std::size_t i = 0; i < robot.bodies().size(); ++i) {
    const RobotBody &x = robot.bodies()[i], &y = truth.bodies()[i];
    CHECK(x.link == y.link);
    CHECK(x.geometry->getNodeType() == y.geometry->getNodeType());
    CHECK(x.geometry->aabb_local.min_ == y.geometry->aabb_local.min_);
    CHECK(x.geometry->aabb_local.max_ == y.geometry->aabb_local.max_);
  }
  std::mt19937_64 random(8);
  double worst = 0.0;
  for (int k = 0; k < states; ++k) {
    const Eigen::VectorXd values = randomValues(truth, random);
    const auto poses = robot.poses(values), expected = truth.poses(values);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Eigen::Matrix4d difference = poses[i].matrix() - expected[i].matrix();
      worst = std::max(worst, difference.cwiseAbs().maxCoeff());
    }
  }
  CHECK(worst <= angle);
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string robotWithMesh(const std::string& name) {
  return "<robot name=\"r\">\n<link name=\"a\"><collision><geometry>\n<mesh filename=\"" + name +
         "\"/></geometry></collision></link></robot>";
}

const char* const kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

template <class Make>
std::string messageOf(const Make& make) {
  try {
    make();
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

std::string messageOfText(const std::string& text, const std::string& folder = {}) {
  return messageOf([&] { Robot::fromText(text, {}, folder); });
}

bool has(const std::string& text, const std::string& part) {
  CAPTURE(text, part);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

RobotOptions optionsOfFetch() {
  RobotOptions options;
  options.packages["fetch_description"] = *modelsFolder() + "/fetch_robot/fetch_description";
  return options;
}

}  // namespace

TEST_CASE("a robot from a text is that from its file") {
  const std::string file = shippedFile("arm.urdf"), text = contentOf(file);
  RobotOptions options;
  options.base.translate(Eigen::Vector3d(1, 2, 3));
  options.links = {"hand", "wrist"};
  const Robot arm = Robot::fromText(text, options);
  checkSameRobot(arm, Robot(file, options), 0.0);
  CHECK(arm.urdf().empty());
  CHECK(arm.urdfText() == text);
  CHECK(arm.folder().empty());
  CHECK(Robot(file).urdf() == file);
  CHECK(Robot(file).urdfText().empty());
  CHECK(Robot(file).folder() == std::filesystem::path(file).parent_path().string());
  const Robot carrying = arm.withAttached({"can", "hand", std::make_shared<fcl::Sphered>(0.1)});
  CHECK(carrying.urdfText() == text);
  checkSameRobot(Robot::fromText(carrying.urdfText(), carrying.options()), arm, 0.0);
  options.base.linear() *= 2.0;
  CHECK_THROWS_AS(Robot::fromText(text, options), InvalidPose);
}

TEST_CASE("faults of a text are told with its lines") {
  CHECK(has(messageOfText(""), "the URDF text: no URDF"));
  CHECK(has(messageOfText("<robot name=\"r\">\n<link/></robot>"), "the URDF text: line 2: link: "));
  CHECK(has(messageOfText("<robot name=\"r\"><link name=\"a\"/></robot>"),
            "the URDF text: no collision element"));
  CHECK(has(messageOfText(std::string("<robot>\0</robot>", 16)), "the URDF text: a control char"));
  CHECK(has(messageOfText(std::string((16 << 20) + 1, ' ')),
            "the URDF text: more than 16777216 bytes"));
}

TEST_CASE("meshes of a text are relative to the folder that is given, or refused") {
  const TemporaryFolder folder;
  folder.write("a.off", kTetrahedron);
  for (const std::string name : {"a.off", "./a.off", "file://a.off"}) {
    const Robot robot = Robot::fromText(robotWithMesh(name), {}, folder.path(""));
    checkSameRobot(robot, Robot(folder.write("r.urdf", robotWithMesh(name))), 0.0, 1);
    CHECK(robot.folder() == folder.path(""));
    const std::string told =
        "the URDF text: line 3: link a: collision 0: " + name + ": is relative";
    CHECK(has(messageOfText(robotWithMesh(name)), told));
  }
  const Robot absolute = Robot::fromText(robotWithMesh(folder.path("a.off")));
  CHECK(absolute.bodies().size() == 1);
  CHECK(Robot::fromText(robotWithMesh("file://" + folder.path("a.off"))).bodies().size() == 1);
  const std::string above = std::filesystem::path(folder.path("x")).parent_path().filename();
  const std::string in_package = robotWithMesh("package://" + above + "/a.off");
  CHECK(Robot::fromText(in_package, {}, folder.path("")).bodies().size() == 1);
  CHECK(has(messageOfText(in_package), "no folder is known for the package " + above));
  CHECK(has(messageOfText(robotWithMesh("a.off"), folder.path("none")), "none/a.off"));
}

TEST_CASE("packages are found where ROS has them, in its order") {
  const TemporaryFolder folder;
  const auto make = [&](const std::string& place) {
    std::filesystem::create_directories(folder.path(place));
    folder.write(place + "/a.off", kTetrahedron);
  };
  const std::string installed = folder.path("first") + ":" + folder.path("second");
  const std::string sources = ":" + folder.path("src") + "::" + folder.path("own/arm/");
  const EnvironmentVariable prefixes("AMENT_PREFIX_PATH", installed);
  const EnvironmentVariable source("ROS_PACKAGE_PATH", sources);
  const auto found = [&](const std::string& name) {
    return messageOfText(robotWithMesh("package://" + name)) == "accepted";
  };
  const std::string missing = messageOfText(robotWithMesh("package://arm/a.off"));
  for (const char* place : {"first/share/arm", "second/share/arm", "src/arm", "own/arm/arm"}) {
    CHECK(has(missing, folder.path(place)));
  }
  CHECK(has(missing, "the URDF text: line 3: link a: collision 0: package://arm/a.off: no folder"));
  // Files and other names are no packages.
  std::filesystem::create_directories(folder.path("src"));
  folder.write("src/arm", "");
  make("own/armature");
  make("first/share");
  CHECK_FALSE(found("arm/a.off"));
  for (const char* name : {"/a.off", "./a.off", "../share/a.off", ".."}) CHECK_FALSE(found(name));
  make("own/arm");
  CHECK(found("arm/a.off"));
  CHECK_FALSE(found("model/a.off"));
  CHECK(has(messageOfText(robotWithMesh("model://arm/a.off")), "for the model arm"));
  // The first of several counts, even if it does not have the mesh.
  std::filesystem::create_directories(folder.path("second/share/arm"));
  CHECK(has(messageOfText(robotWithMesh("package://arm/a.off")),
            folder.path("second/share/arm/a.off")));
  make("first/share/arm");
  CHECK(found("arm/a.off"));
  RobotOptions options;
  options.packages["arm"] = folder.path("nowhere");
  CHECK(has(messageOf([&] { Robot::fromText(robotWithMesh("package://arm/a.off"), options); }),
            "there is no " + folder.path("nowhere")));
}

TEST_CASE("a model of urdfdom is the robot of its file") {
  const std::string arm = shippedFile("arm.urdf");
  checkSameRobot(robotFromModel(*urdf::parseURDFFile(arm)), Robot(arm), 1e-14);
  const auto fetch = modelOrSkip("fetch_robot/fetch_description/robots/fetch.urdf");
  const auto kuka = modelOrSkip("kuka_iiwa/model.urdf");
  const auto human = modelOrSkip("human_urdf/humanSubject04_48dof.urdf");
  if (!fetch || !kuka || !human) return;
  checkSameRobot(robotFromModel(*urdf::parseURDFFile(*fetch), optionsOfFetch()),
                 Robot(*fetch, optionsOfFetch()), 1e-13);
  const std::string beside = std::filesystem::path(*kuka).parent_path().string();
  checkSameRobot(robotFromModel(*urdf::parseURDFFile(*kuka), {}, beside), Robot(*kuka), 1e-13);
  checkSameRobot(robotFromModel(*urdf::parseURDFFile(*human)), Robot(*human), 1e-13);
}

TEST_CASE("rotations of a model are kept where roll and yaw turn about nearly one axis") {
  for (const double pitch :
       {0.0, 1.5, 1.5707, 1.5707963267948966, 1.571, -1.57, -1.5707963267948966, 3.0, -2.5}) {
    std::ostringstream text;
    text.precision(17);
    text << "<robot name=\"&lt;&quot;&amp;\"><link name=\"a\"><collision><origin rpy=\"0.3 "
         << pitch << " -1.2\" xyz=\"0.1 0.123456789012345678 1e-9\"/><geometry>"
         << "<box size=\"1 0.1 0.333333333333333315\"/></geometry></collision></link></robot>";
    const auto model = urdf::parseURDF(text.str());
    checkSameRobot(robotFromModel(*model), Robot::fromText(text.str()), 5e-15, 1);
  }
}

TEST_CASE("what is wrong with a model is refused as in a text") {
  const auto withMesh = [](const std::string& name) {
    const auto model = urdf::parseURDF(robotWithMesh(name));
    return messageOf([&] { robotFromModel(*model); });
  };
  CHECK(has(withMesh("a&amp;b.off"), "link a: collision 0: a&b.off: is relative"));
  auto model = urdf::parseURDFFile(shippedFile("arm.urdf"));
  model->joints_.at("elbow")->type = urdf::Joint::FLOATING;
  CHECK(has(messageOf([&] { robotFromModel(*model); }), "joint elbow: its type is floating"));
  model = urdf::parseURDFFile(shippedFile("arm.urdf"));
  model->links_.at("hand")->collision_array.at(0)->geometry.reset();
  CHECK(has(messageOf([&] { robotFromModel(*model); }), "link hand: collision 0: geometry: has 0"));
  model = urdf::parseURDFFile(shippedFile("arm.urdf"));
  model->joints_.at("elbow")->limits->upper = std::nan("");
  CHECK(has(messageOf([&] { robotFromModel(*model); }), "joint elbow: limit: upper"));
  // A model that a program has made may have the only collision element beside the list of them.
  model = urdf::parseURDFFile(shippedFile("arm.urdf"));
  model->links_.at("hand")->collision_array.clear();
  checkSameRobot(robotFromModel(*model), shippedArm(), 1e-14);
}
