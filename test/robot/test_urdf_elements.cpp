// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Nothing of a URDF that says where bodies are may get lost: elements and attributes that are
// misspelt, misplaced or not expanded, each at every place where one may stand.
#include <algorithm>
#include <string>
#include <vector>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Lines = std::vector<std::string>;

/// A robot with every element that is read, one a line.
const Lines& wholeRobot() {
  static const Lines lines{"<?xml version=\"1.0\"?>",
                           "<robot name=\"r\">",
                           "<link name=\"a\">",
                           "<collision>",
                           "<origin xyz=\"0 0 0.1\" rpy=\"0.1 0.2 0.3\"/>",
                           "<geometry>",
                           "<box size=\"0.1 0.2 0.3\"/>",
                           "</geometry>",
                           "</collision>",
                           "</link>",
                           "<link name=\"b\"><collision><geometry>",
                           "<cylinder radius=\"0.1\" length=\"0.2\"/>",
                           "</geometry></collision></link>",
                           "<link name=\"c\"><collision><geometry>",
                           "<sphere radius=\"0.1\"/>",
                           "</geometry></collision><collision><geometry>",
                           "<capsule radius=\"0.1\" length=\"0.2\"/>",
                           "</geometry></collision></link>",
                           "<joint name=\"j\" type=\"revolute\">",
                           "<parent link=\"a\"/>",
                           "<child link=\"b\"/>",
                           "<origin xyz=\"0 0 1\"/>",
                           "<axis xyz=\"0 1 0\"/>",
                           "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>",
                           "</joint>",
                           "<joint name=\"k\" type=\"prismatic\">",
                           "<parent link=\"b\"/>",
                           "<child link=\"c\"/>",
                           "<limit lower=\"-3\" upper=\"3\"/>",
                           "<mimic joint=\"j\" multiplier=\"2\" offset=\"0.5\"/>",
                           "</joint>",
                           "</robot>"};
  return lines;
}

std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

Lines withLine(std::size_t number, const std::string& line) {
  Lines lines = wholeRobot();
  lines[number - 1] = line;
  return lines;
}

Lines withInserted(std::size_t before, const std::string& line) {
  Lines lines = wholeRobot();
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(before - 1), line);
  return lines;
}

/// The message; empty if it is taken.
std::string refusalOf(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("r.urdf", text);
  try {
    const Robot robot(path);
    return "";
  } catch (const FileError& error) {
    CHECK(std::string(error.what()).find(path + ": ") == 0);
    return error.what();
  }
}

void refusedAt(std::size_t line, const std::string& told, const std::string& text) {
  const std::string message = refusalOf(text);
  CAPTURE(text, message, told, line);
  CHECK(message.find(": line " + std::to_string(line) + ": ") != std::string::npos);
  CHECK(message.find(told) != std::string::npos);
}

/// As people mistype a word.
Lines misspelt(const std::string& word) {
  std::string swapped = word, capital = word, doubled = word;
  std::swap(swapped[0], swapped[1]);
  capital[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(capital[0])));
  doubled.insert(1, 1, word[1]);
  std::string upper = word;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return {word.substr(1), word.substr(0, word.size() - 1), word + "s", swapped, capital, doubled,
          upper};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

void requireSame(const Robot& robot, const Robot& other) {
  REQUIRE(robot.bodies().size() == other.bodies().size());
  REQUIRE(robot.joints().size() == other.joints().size());
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(1, 0.3);
  const auto poses = robot.poses(values), others = other.poses(values);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CHECK(poses[i].matrix() == others[i].matrix());
    CHECK(robot.bodies()[i].geometry->getNodeType() == other.bodies()[i].geometry->getNodeType());
  }
}

Robot robotOf(const std::string& text) {
  const TemporaryFolder folder;
  return Robot(folder.write("r.urdf", text));
}

/// Lines before which something may be put into each of the elements that hold others.
const std::vector<std::pair<std::string, std::size_t>>& containers() {
  static const std::vector<std::pair<std::string, std::size_t>> all{{"robot", 3},
                                                                    {"link a", 4},
                                                                    {"link a: collision 0", 5},
                                                                    {"collision 0: geometry", 7},
                                                                    {"joint j", 20}};
  return all;
}

}  // namespace

TEST_CASE("the whole robot is read") {
  const Robot robot = robotOf(joined(wholeRobot()));
  CHECK(robot.bodies().size() == 4);
  CHECK(robot.linksWithoutBody().empty());
  CHECK(robot.notes().empty());
}

TEST_CASE("a misspelt element is refused by file, line and name") {
  std::size_t looked_at = 0;
  for (std::size_t number = 3; number <= wholeRobot().size(); ++number) {
    const std::string& line = wholeRobot()[number - 1];
    if (line.compare(0, 2, "</") == 0) continue;
    const std::string word = line.substr(1, line.find_first_of(" />") - 1);
    for (const std::string& wrong : misspelt(word)) {
      std::string text = replaced(line, "<" + word, "<" + wrong);
      text = replaced(text, "</" + word + ">", "</" + wrong + ">");
      Lines lines = withLine(number, text);
      // The end of what does not end in its line.
      const bool ends =
          line.find("/>") != std::string::npos || line.find("</" + word) != std::string::npos;
      const auto begin = lines.begin() + static_cast<std::ptrdiff_t>(number);
      const auto end = std::find_if(begin, lines.end(), [&](const std::string& one) {
        return one.find("</" + word + ">") != std::string::npos;
      });
      if (!ends && end != lines.end()) *end = replaced(*end, "</" + word + ">", "</" + wrong + ">");
      refusedAt(number, wrong, joined(lines));
      ++looked_at;
    }
  }
  CHECK(looked_at > 100);
}

TEST_CASE("a misspelt attribute is refused by file, line and name") {
  std::size_t looked_at = 0;
  for (std::size_t number = 3; number <= wholeRobot().size(); ++number) {
    const std::string& line = wholeRobot()[number - 1];
    for (std::size_t equals = line.find('='); equals != std::string::npos;
         equals = line.find('=', equals + 1)) {
      const std::size_t begin = line.find_last_of(' ', equals) + 1;
      const std::string word = line.substr(begin, equals - begin);
      for (const std::string& wrong : misspelt(word)) {
        const std::string text = line.substr(0, begin) + wrong + line.substr(equals);
        const bool holds_others = word == "name" || word == "type";
        refusedAt(number, holds_others ? "has no " + word : wrong, joined(withLine(number, text)));
        ++looked_at;
      }
    }
  }
  CHECK(looked_at > 100);
}

TEST_CASE("what is not known is refused in whatever it stands") {
  for (const auto& [where, line] : containers()) {
    for (const std::string unknown :
         {"colision", "collisions", "xacro:arm", "xacro:include", "xi:include", "include", "macro",
          "property", "drake:joint", "other:link", "model", "pose", "loop_joint", "urdf:collision",
          "Gazebo", "joints"}) {
      CAPTURE(where, unknown);
      for (const std::string& text :
           {"<" + unknown + "/>", "<" + unknown + " name=\"x\">\n</" + unknown + ">"}) {
        refusedAt(line, unknown, joined(withInserted(line, text)));
      }
    }
  }
  // Elements that are read, where nobody reads them.
  for (const auto& [where, line] : containers()) {
    for (const std::string misplaced : {"axis", "limit", "mimic", "box", "robot"}) {
      const bool belongs = (where == "joint j" && misplaced != "box" && misplaced != "robot") ||
                           (where == "collision 0: geometry" && misplaced == "box");
      if (belongs) continue;
      refusedAt(line, misplaced, joined(withInserted(line, "<" + misplaced + "/>")));
    }
  }
  refusedAt(
      4, "collision",
      joined(withInserted(
          4,
          "<visual><collision><geometry><box size=\"1 1 1\"/></geometry></collision></visual>")));
}

TEST_CASE("a macro is known by what its prefix stands for, and expressions by their form") {
  const std::string head = "<robot name=\"r\" xmlns:m=\"http://www.ros.org/wiki/xacro\">";
  Lines lines = withInserted(3, "<m:arm/>");
  lines[1] = head;
  refusedAt(3, "m:arm: xacro has not been run", joined(lines));
  CHECK(refusalOf(joined(withLine(2, head))).empty());
  for (std::size_t number = 3; number <= wholeRobot().size(); ++number) {
    const std::string& line = wholeRobot()[number - 1];
    const std::size_t begin = line.find("=\"");
    if (begin == std::string::npos) continue;
    const std::size_t end = line.find('"', begin + 2);
    for (const std::string expression : {"${x}", "$(arg x)", "${0.5*pi}"}) {
      refusedAt(
          number, "xacro has not been run",
          joined(withLine(number, line.substr(0, begin + 2) + expression + line.substr(end))));
    }
  }
}

TEST_CASE("what says nothing of bodies changes nothing") {
  const Robot robot = robotOf(joined(wholeRobot()));
  for (const auto& [where, line] : containers()) {
    for (const std::string harmless :
         {"<visual><geometry><capsule radius=\".1\" length=\"1\"/></geometry></visual>",
          "<visual><geometry><mesh filename=\"none.dae\" scale=\"x\"/></geometry></visual>",
          "<inertial><mass value=\"nan\"/><inertia ixx=\"${i}\"/></inertial>",
          "<gazebo reference=\"a\"><mu1>50 %</mu1><![CDATA[ %n%s <a> ]]></gazebo>",
          "<gazebo><collision><geometry><box/></geometry></collision></gazebo>",
          "<transmission name=\"t\"><joint name=\"j\"/><type>x</type></transmission>",
          "<material name=\"%n%s\"><color rgba=\"1 0 0 1\"/></material>",
          "<ros2_control name=\"x\"><joint name=\"j\"/></ros2_control>",
          "<dynamics damping=\"0.1\"/>",
          "<calibration rising=\"0\"/>",
          "<safety_controller k_velocity=\"1\"/>",
          "<self_collision_checking/>",
          "<sensor name=\"s\"><parent link=\"a\"/><origin xyz=\"1 2 3\"/></sensor>",
          "<contact><lateral_friction value=\"1\"/></contact>",
          "<verbose value=\"1\"/>",
          "<mujoco><compiler meshdir=\"x\"/></mujoco>",
          "<drake:proximity_properties/>",
          "<sensor:camera name=\"c\"/>",
          "<group name=\"arm\"><joint name=\"j\"/></group>",
          "<!-- ---- 100 % ---- -->",
          "text",
          "<?xml-model href=\"x\"?>"}) {
      CAPTURE(where, harmless);
      requireSame(robot, robotOf(joined(withInserted(line, harmless))));
    }
  }
  requireSame(robot, robotOf(replaced(joined(wholeRobot()), "<origin xyz",
                                      "<origin drake:note=\"1\" xyz")));
  requireSame(robot, robotOf(replaced(joined(wholeRobot()), "<robot ",
                                      "<robot xmlns=\"http://www.ros.org\" version=\"1.0\" ")));
  requireSame(robot, robotOf(replaced(joined(wholeRobot()), "<link ", "<link type=\"x\" ")));
}

TEST_CASE("values are numbers, as many as there have to be") {
  for (std::size_t number = 5; number <= wholeRobot().size(); ++number) {
    const std::string& line = wholeRobot()[number - 1];
    for (const std::string attribute :
         {"xyz", "rpy", "size", "radius", "length", "lower", "upper", "multiplier", "offset"}) {
      const std::size_t begin = line.find(attribute + "=\"");
      if (begin == std::string::npos) continue;
      const std::size_t from = begin + attribute.size() + 2, end = line.find('"', from);
      for (const std::string wrong :
           {"0,5", "0, 0, 1", "0;0;1", "nan", "inf", "0 0", "0 0 0 1", "", " ", "1e999", "0x1p3x",
            "90deg", "0 0 1.", "0 - 1", "1 2 three", "true", "%n%s"}) {
        const bool is_list = attribute == "xyz" || attribute == "rpy" || attribute == "size";
        if (is_list && wrong == "0 0 1.") continue;
        refusedAt(number, attribute,
                  joined(withLine(number, line.substr(0, from) + wrong + line.substr(end))));
      }
    }
  }
  const auto shape = [](const std::string& text) { return joined(withLine(7, text)); };
  for (const std::string wrong : {"0", "-0.1"}) {
    refusedAt(7, "radius", shape("<sphere radius=\"" + wrong + "\"/>"));
    refusedAt(7, "radius", shape("<capsule radius=\"" + wrong + "\" length=\"1\"/>"));
    refusedAt(7, "length", shape("<capsule length=\"" + wrong + "\" radius=\"1\"/>"));
    refusedAt(7, "size", shape("<box size=\"1 " + wrong + " 1\"/>"));
    refusedAt(7, "scale", shape("<mesh filename=\"a.stl\" scale=\"1 x 1\"/>"));
  }
  refusedAt(7, "filename", shape("<mesh scale=\"1 1 1\"/>"));
  refusedAt(7, "none.stl", shape("<mesh filename=\"none.stl\"/>"));
  refusedAt(6, "has 2", joined(withInserted(7, "<sphere radius=\"1\"/>")));
  refusedAt(6, "has 0", joined(withLine(7, "")));
  refusedAt(5, "text", joined(withLine(5, "<origin>0 0 1</origin>")));
}

TEST_CASE("what hangs together wrongly is refused by file, line and element") {
  const auto at = [](std::size_t line, const std::string& text) {
    return joined(withLine(line, text));
  };
  refusedAt(11, "link a: is there twice",
            replaced(at(11, wholeRobot()[10]), "<link name=\"b\"", "<link name=\"a\""));
  refusedAt(26, "joint j: is there twice",
            replaced(joined(wholeRobot()), "name=\"k\"", "name=\"j\""));
  refusedAt(20, "no link z", at(20, "<parent link=\"z\"/>"));
  refusedAt(21, "no link z", at(21, "<child link=\"z\"/>"));
  refusedAt(19, "no element parent", at(20, ""));
  refusedAt(19, "no element child", at(21, ""));
  refusedAt(22, "2 elements child", at(22, "<child link=\"c\"/>"));
  refusedAt(19, "has no limit", at(24, ""));
  refusedAt(24, "lower is above upper", at(24, "<limit lower=\"1\" upper=\"-1\"/>"));
  refusedAt(23, "length", at(23, "<axis xyz=\"0 0 0\"/>"));
  refusedAt(26, "mimics z", at(30, "<mimic joint=\"z\"/>"));
  refusedAt(26, "mimics itself", at(30, "<mimic joint=\"k\"/>"));
  refusedAt(26, "more than one joint", at(28, "<child link=\"b\"/>"));
  refusedAt(3, "does not hang on the root link", at(28, "<child link=\"a\"/>"));
  refusedAt(3, "hangs on no joint", joined(withInserted(3, "<link name=\"z\"/>")));
  for (const std::string type :
       {"floating", "planar", "spherical", "Revolute", "hinge", "unknown"}) {
    refusedAt(19, "its type is " + type, at(19, "<joint name=\"j\" type=\"" + type + "\">"));
  }
  refusedAt(19, "has no type", at(19, "<joint name=\"j\">"));
  refusedAt(19, "has no type", at(19, "<joint name=\"j\" type=\"\">"));
}

TEST_CASE("files are read as editors leave them") {
  const std::string text = joined(wholeRobot());
  const Robot robot = robotOf(text);
  requireSame(robot, robotOf("\xef\xbb\xbf" + text));
  requireSame(robot, robotOf("\n  \r\n" + text));
  requireSame(robot, robotOf(replaced(text, "\n", "\r\n")));
  requireSame(robot, robotOf(replaced(text, "<robot", "<!-- a -- b -->\n<robot")));
  requireSame(robot, robotOf(text + "<!-- the end -->\n"));
  requireSame(robot,
              robotOf(replaced(text, "\"1.0\"", "\"1.0\" encoding='utf-8' standalone=\"yes\"")));
  requireSame(robot, robotOf(replaced(text, "xyz=\"0 0 1\"", "xyz=\"\n 0\t+0 1e0 \"")));
  const std::string latin =
      replaced(replaced(text, "\"1.0\"", "\"1.0\" encoding=\"ISO-8859-1\""), "\"c\"", "\"\xe9\"");
  CHECK(robotOf(latin).links().back().name == "\u00e9");
  // Lines are those of the file, wherever its first element is.
  refusedAt(7, "colision", "\n\n" + joined(withInserted(5, "<colision/>")));
  refusedAt(1, "document type", replaced(text, "<?xml version=\"1.0\"?>", "<!DOCTYPE robot>"));
  for (const std::size_t number : {3U, 10U, 25U}) {
    CHECK_FALSE(refusalOf(joined(withLine(number, ""))).empty());
    CHECK_FALSE(refusalOf(joined(withInserted(number, "<a b=c/>"))).empty());
    CHECK_FALSE(refusalOf(joined(withInserted(number, "<a b='1' b='2'/>"))).empty());
    CHECK_FALSE(refusalOf(joined(withInserted(number, "&what;"))).empty());
  }
}

TEST_CASE("angles and limits of more than a turn are told as what they probably are") {
  for (const double limit : {6.2, 6.5, 90.0, 170.0}) {
    const std::string text = std::to_string(limit);
    const Robot robot =
        robotOf(joined(withLine(24, "<limit lower=\"-" + text + "\" upper=\"1\"/>")));
    CHECK(robot.notes().size() == (limit > 6.3 ? 1U : 0U));
    const Robot turned = robotOf(joined(withLine(22, "<origin rpy=\"0 " + text + " 0\"/>")));
    CHECK(turned.notes().size() == (limit > 6.3 ? 1U : 0U));
    if (limit < 6.3) continue;
    CHECK(robot.notes()[0].find("line 24: joint j: limit") != std::string::npos);
    CHECK(turned.notes()[0].find("line 22: joint j: origin") != std::string::npos);
    CHECK(turned.notes()[0].find("probably degrees") != std::string::npos);
  }
  CHECK(robotOf(joined(withLine(29, "<limit lower=\"-100\" upper=\"100\"/>"))).notes().empty());
}

TEST_CASE("links without a body are listed") {
  Lines lines = withInserted(3, "<link name=\"frame\"/>");
  lines.insert(
      lines.end() - 1,
      "<joint name=\"f\" type=\"fixed\"><parent link=\"a\"/><child link=\"frame\"/></joint>");
  CHECK(robotOf(joined(lines)).linksWithoutBody() == Lines{"frame"});
  const TemporaryFolder folder;
  RobotOptions options;
  options.links = {"b", "a"};
  const Robot taken(folder.write("r.urdf", joined(lines)), options);
  Lines without = taken.linksWithoutBody();
  std::sort(without.begin(), without.end());
  CHECK(without == Lines{"c", "frame"});
}
