// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Kinematics against a product of transforms that this file makes itself; URDFs that are none.
#include "fcl_prob/robot.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/capsule.h>
#include <urdf_parser/urdf_parser.h>
#include <atomic>
#include <thread>

#include <filesystem>
#include <limits>
#include <map>

#include "arm_cases.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "models.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

fcl::Transform3d poseOf(const urdf::Pose& pose) {
  double roll, pitch, yaw;
  pose.rotation.getRPY(roll, pitch, yaw);
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.translate(Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z));
  result.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  result.rotate(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
  result.rotate(Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return result;
}

/// From a link up to the root, joint by joint.
class UpwardKinematics {
 public:
  explicit UpwardKinematics(const std::string& path) : model_(urdf::parseURDFFile(path)) {}

  fcl::Transform3d linkPose(const std::string& link,
                            const std::map<std::string, double>& values) const {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    for (auto at = model_->getLink(link); at->parent_joint; at = at->getParent()) {
      pose = poseOf(at->parent_joint->parent_to_joint_origin_transform) *
             moved(*at->parent_joint, values) * pose;
    }
    return pose;
  }

  std::vector<std::string> links() const {
    std::vector<std::string> names;
    for (const auto& [name, link] : model_->links_) names.push_back(name);
    return names;
  }

 private:
  double valueOf(const urdf::Joint& joint, const std::map<std::string, double>& values) const {
    if (!joint.mimic) return values.at(joint.name);
    const auto& mimic = *joint.mimic;
    return mimic.multiplier * valueOf(*model_->getJoint(mimic.joint_name), values) + mimic.offset;
  }

  fcl::Transform3d moved(const urdf::Joint& joint,
                         const std::map<std::string, double>& values) const {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    if (joint.type == urdf::Joint::FIXED) return result;
    const Eigen::Vector3d axis =
        Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
    const double value = valueOf(joint, values);
    if (joint.type == urdf::Joint::PRISMATIC) return result.translate(value * axis);
    return result.rotate(Eigen::AngleAxisd(value, axis));
  }

  urdf::ModelInterfaceSharedPtr model_;
};

void checkKinematics(const Robot& robot, const std::string& path, int states) {
  const UpwardKinematics truth(path);
  std::mt19937_64 random(5);
  double worst = 0.0;
  for (int i = 0; i < states; ++i) {
    const Eigen::VectorXd values = randomValues(robot, random);
    std::map<std::string, double> by_name;
    for (std::size_t j = 0; j < robot.joints().size(); ++j) {
      by_name[robot.joints()[j].name] = values[static_cast<Eigen::Index>(j)];
    }
    REQUIRE(robot.values(by_name) == values);
    for (const std::string& link : truth.links()) {
      const Eigen::Matrix4d difference =
          robot.linkPose(link, values).matrix() - truth.linkPose(link, by_name).matrix();
      worst = std::max(worst, difference.cwiseAbs().maxCoeff());
    }
  }
  CHECK(worst < 1e-12);
}

std::string urdfWith(const std::string& inside) {
  return "<robot name=\"r\"><link name=\"a\"><collision><geometry><sphere radius=\"0.1\"/>"
         "</geometry></collision></link>" +
         inside + "</robot>";
}

std::string hangs(const std::string& child, const std::string& parent, const std::string& joint) {
  return "<joint name=\"" + joint + "\" type=\"fixed\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/></joint>";
}

void refused(const std::string& text, const std::string& told) {
  const TemporaryFolder folder;
  const std::string path = folder.write("bad.urdf", text);
  try {
    const Robot robot(path);
  } catch (const FileError& error) {
    CAPTURE(error.what(), told);
    CHECK(std::string(error.what()).find(path) == 0);
    CHECK(std::string(error.what()).find(told) != std::string::npos);
    return;
  }
  FAIL("accepted: " + text);
}

}  // namespace

TEST_CASE("links are where a product of transforms puts them") {
  checkKinematics(shippedArm(), shippedFile("arm.urdf"), 200);
}

TEST_CASE("links of other people's robots are where a product of transforms puts them") {
  const auto fetch = modelOrSkip("fetch_robot/fetch_description/robots/fetch.urdf");
  const auto kuka = modelOrSkip("kuka_iiwa/model.urdf");
  if (!fetch || !kuka) return;
  RobotOptions options;
  options.packages["fetch_description"] = *modelsFolder() + "/fetch_robot/fetch_description";
  const Robot robot(*fetch, options);
  CHECK(robot.bodies().size() >= 20);
  checkKinematics(robot, *fetch, 50);
  checkKinematics(Robot(*kuka), *kuka, 50);
}

TEST_CASE("poses asked for by several threads at once are those of one") {
  const Robot arm = shippedArm();
  std::mt19937_64 random(5);
  std::vector<Eigen::VectorXd> values;
  for (int i = 0; i < 50; ++i) values.push_back(randomValues(arm, random));
  std::vector<std::vector<fcl::Transform3d>> alone;
  for (const Eigen::VectorXd& state : values) alone.push_back(arm.poses(state));
  std::atomic<int> wrong{0};
  const auto ask = [&](std::size_t first) {
    for (std::size_t i = 0; i < 20'000; ++i) {
      const std::size_t k = (first + 7 * i) % values.size();
      const auto poses = arm.poses(values[k]);
      for (std::size_t b = 0; b < poses.size(); ++b) {
        if (poses[b].matrix() != alone[k][b].matrix()) ++wrong;
      }
    }
  };
  std::thread other(ask, std::size_t{0});
  ask(3);
  other.join();
  CHECK(wrong == 0);
}

TEST_CASE("bodies are the collision elements, with limits and mimic joints as the URDF has them") {
  const Robot arm = shippedArm();
  CHECK(arm.name() == "arm");
  CHECK(arm.joints().size() == 6);  // grip_right is no joint of its own
  CHECK(arm.bodies().size() == 10);
  CHECK(shippedArm({"hand", "wrist"}).bodies().size() == 2);
  const Eigen::VectorXd values = arm.values({{"grip", 0.02}, {"shoulder", -0.5}});
  CHECK(arm.isWithinLimits(values));
  CHECK_FALSE(arm.isWithinLimits(arm.values({{"elbow", 2.5}})));
  const Eigen::Vector3d apart = arm.linkPose("left_finger", values).translation() -
                                arm.linkPose("right_finger", values).translation();
  CHECK(apart.norm() == Approx(0.04).epsilon(1e-12));
  for (std::size_t i = 0; i < arm.bodies().size(); ++i) {
    const RobotBody& body = arm.bodies()[i];
    const Eigen::Matrix4d expected = (arm.linkPose(body.link, values) * body.in_link).matrix();
    CHECK((arm.poses(values)[i].matrix() - expected).norm() < 1e-15);
  }
}

TEST_CASE("a robot stands on its base") {
  RobotOptions options;
  options.base.translate(Eigen::Vector3d(1, 2, 3));
  options.base.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  const Robot moved(shippedFile("arm.urdf"), options);
  const Robot arm = shippedArm();
  const Eigen::VectorXd values = arm.values({});
  CHECK((moved.linkPose("tool", values).matrix() -
         (options.base * arm.linkPose("tool", values)).matrix())
            .norm() < 1e-14);
}

TEST_CASE("values of joints are checked") {
  const Robot arm = shippedArm();
  CHECK_THROWS_AS(arm.values({{"knee", 1.0}}), InvalidRequest);
  CHECK_THROWS_AS(arm.values({{"elbow", std::nan("")}}), InvalidRequest);
  CHECK_THROWS_AS(arm.poses(Eigen::VectorXd::Zero(5)), InvalidRequest);
  CHECK_THROWS_AS(arm.linkPose("foot", Eigen::VectorXd::Zero(6)), InvalidRequest);
  CHECK_THROWS_AS(shippedArm({"foot"}), FileError);
}

TEST_CASE("meshes of a URDF are found, scaled and mirrored") {
  const TemporaryFolder folder;
  folder.write("tetrahedron.off",
               "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const auto robotWith = [&](const std::string& mesh) {
    return folder.write("r.urdf", "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh " +
                                      mesh + "/></geometry></collision></link></robot>");
  };
  RobotOptions options;
  options.packages["here"] = folder.path("");
  folder.write("of three words.off", folder.read("tetrahedron.off"));
  const std::string above = std::filesystem::path(folder.path("x")).parent_path().filename();
  const std::vector<std::string> names{"tetrahedron.off",
                                       "of three words.off",
                                       "file://" + folder.path("tetrahedron.off"),
                                       "file://localhost" + folder.path("tetrahedron.off"),
                                       "file://" + folder.path("of%20three%20words.off"),
                                       "file://" + folder.path("of three words.off"),
                                       "file://" + folder.path("%74etrahedron%2Eoff"),
                                       "package://here/tetrahedron.off",
                                       "package://here/of%20three%20words.off",
                                       "model://here/tetrahedron.off",
                                       "package://" + above + "/tetrahedron.off",
                                       "model://" + above + "/tetrahedron.off"};
  for (const std::string& name : names) {
    const Robot robot(robotWith("filename=\"" + name + "\" scale=\"-2 3 0.5\""), options);
    const auto& model =
        dynamic_cast<const fcl::BVHModel<fcl::OBBRSSd>&>(*robot.bodies()[0].geometry);
    CHECK(model.num_tris == 4);
    CHECK(model.aabb_local.min_.isApprox(Eigen::Vector3d(-2, 0, 0)));
    CHECK(model.aabb_local.max_.isApprox(Eigen::Vector3d(0, 3, 0.5)));
    CHECK(model.computeVolume() == Approx(0.5));  // negative were it inside out
  }
  folder.write("empty.off", "OFF\n0 0 0\n");
  for (const std::string bad :
       {"package://there/tetrahedron.off", "model://there/tetrahedron.off", "package://here",
        "package://here/none.off", "none.off", "file:///none.off", "empty.off",
        "of%20three%20words.off", "http://here/tetrahedron.off", "file://%00", "tetrahedron.urdf",
        "tetrahedron"}) {
    const std::string path = robotWith("filename=\"" + bad + "\"");
    CAPTURE(bad);
    try {
      const Robot robot(path, options);
      FAIL("accepted");
    } catch (const Exception& error) {
      CAPTURE(error.what());
      CHECK(std::string(error.what()).find(path + ": line 1: link a: collision 0: ") == 0);
    }
  }
  CHECK_THROWS_AS(Robot(robotWith("filename=\"tetrahedron.off\" scale=\"1 0 1\"")), FileError);
}

TEST_CASE("a capsule is one, its length without the ends") {
  const TemporaryFolder folder;
  const Robot robot(folder.write(
      "r.urdf",
      "<robot name=\"r\"><link name=\"a\"><collision><geometry><capsule radius=\"0.1\" "
      "length=\"0.3\"/></geometry></collision></link></robot>"));
  const auto& capsule = dynamic_cast<const fcl::Capsuled&>(*robot.bodies()[0].geometry);
  CHECK(capsule.radius == 0.1);
  CHECK(capsule.lz == 0.3);
}

TEST_CASE("names may have any letters, and lines end as they do anywhere") {
  const TemporaryFolder folder;
  const std::string text =
      "\r\n\t<!-- 100 % --><link name=\"\u00e9\u6249\"/><joint name=\"j\" type=\"fixed\">"
      "<parent link=\"a\"/><child link=\"\u00e9\u6249\"/></joint>";
  const Robot robot(folder.write("r.urdf", urdfWith(text)));
  CHECK(robot.links().back().name == "\u00e9\u6249");
}

TEST_CASE("what is no URDF is refused with file and element") {
  const auto joint = [](const std::string& type, const std::string& inside) {
    return urdfWith("<link name=\"b\"/><joint name=\"j\" type=\"" + type +
                    "\"><parent link=\"a\"/><child link=\"b\"/>" + inside + "</joint>");
  };
  const std::string limit = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
  refused("", "no URDF");
  refused("nothing of the kind", "no URDF");
  refused("<robot name=\"r\"/>", "no URDF");
  refused("<robot name=\"r\"><link name=\"a\"/></robot>", "no collision element");
  refused("<!DOCTYPE r [<!ENTITY e \"e\">]>" + urdfWith(""), "document type");
  refused(joint("floating", ""), "joint j");
  refused(joint("revolute", "<axis xyz=\"0 0 0\"/>" + limit), "joint j");
  refused(joint("revolute", "<limit lower=\"1\" upper=\"-1\" effort=\"1\" velocity=\"1\"/>"),
          "joint j: limit: lower is above upper: 1 to -1");
  refused(joint("revolute", limit + "<mimic joint=\"j\"/>"), "joint j: mimics itself");
  refused(joint("revolute", limit + "<mimic joint=\"k\"/>"), "joint j: mimics k");
  const auto shape = [](const std::string& inside) {
    return "<robot name=\"r\"><link name=\"a\"><collision>" + inside +
           "</collision></link></robot>";
  };
  refused(shape("<geometry><sphere radius=\"-1\"/></geometry>"), "link a: collision 0: radius");
  refused(shape("<geometry><box size=\"1 0 1\"/></geometry>"), "link a: collision 0: size");
  refused(shape("<geometry><cylinder radius=\"1\" length=\"0\"/></geometry>"),
          "link a: collision 0: length");
  // Where a link has another element that is right, too.
  const std::string good = "<geometry><sphere radius=\"1\"/></geometry></collision><collision>";
  for (const std::string bad :
       {"<geometry><sphere radius=\"nan\"/></geometry>", "<geometry><cone/></geometry>",
        "<geometry><box size=\"1,1,1\"/></geometry>",
        "<origin xyz=\"0 0\"/><geometry><sphere radius=\"1\"/></geometry>",
        "<geometry><cylinder radius=\"0.1\"/></geometry>", "", "<geometry/>",
        "<geometry><sphere radius=\"1\"/><sphere radius=\"2\"/></geometry>",
        "<geometry><sphere radius=\"1\"/></geometry><geometry><sphere radius=\"2\"/></geometry>"}) {
    refused(shape(bad), "line 1: link a: collision 0");
    refused(shape(good + bad), "line 1: link a: collision 1");
  }
  refused(shape("<geometry><mesh filename=\"package://a%20b/c\"/></geometry>"), "package a b");
  refused(joint("revolute", "<axis xyz=\"1e200 0 0\"/>" + limit), "joint j: axis: its length");
  refused(urdfWith("<link name=\"\xff\"/>"), "not proper UTF-8");
  refused(urdfWith("<link name=\"\x1b\"/>"), "control character, character");
  refused(urdfWith("<link name=\"\x7f\"/>"), "control character, character");
  refused("\x01" + urdfWith(""), "control character, character 0");
  refused(urdfWith("") + urdfWith(""), "Extra content at the end");
  refused("<gripper name=\"r\"/>", "no URDF: its element is gripper, not robot");
  std::string deep, ends;
  for (int i = 0; i < 100; ++i) {
    deep += "<a>";
    ends += "</a>";
  }
  refused(urdfWith("<gazebo>" + deep + ends + "</gazebo>"), "nested deeper");
  for (int i = 0; i < 10; ++i) deep += deep;
  refused(deep, "no URDF: Excessive depth");
  refused("<a\">" + deep, "no URDF");
  refused("<!-->" + deep + "-->" + deep, "no URDF");
  refused("<a></a></a>", "no URDF");
  refused("<a><b", "no URDF");
  refused("<", "no URDF");
  std::string entities = "<!DOCTYPE r [<!ENTITY a \"aaaaaaaaaa\">";
  for (char c = 'b'; c < 'm'; ++c) {
    const std::string before = std::string("&") + static_cast<char>(c - 1) + ";";
    entities += std::string("<!ENTITY ") + c + " \"";
    for (int i = 0; i < 10; ++i) entities += before;
    entities += "\">";
  }
  refused(entities + "]>" + urdfWith("&l;"), "line 1: no URDF: a document type");
  refused(urdfWith("<link name=\"b\"/>" + hangs("b", "b", "j")), "");
}

TEST_CASE("a link on more than one joint is refused, and so are loops of links") {
  const std::string links = "<link name=\"b\"/><link name=\"c\"/>" + hangs("b", "a", "j");
  const TemporaryFolder folder;
  const Robot robot(folder.write("r.urdf", urdfWith(links + hangs("c", "b", "k"))));
  CHECK(robot.links().size() == 3);
  const std::string told = " hangs on more than one joint";
  refused(urdfWith(links + hangs("c", "a", "k") + hangs("c", "a", "l")), "link c" + told);
  refused(urdfWith(links + hangs("c", "a", "k") + hangs("c", "b", "l")), "link c" + told);
  refused(urdfWith(links + hangs("c", "b", "k") + hangs("b", "c", "l")), "link b" + told);
}
