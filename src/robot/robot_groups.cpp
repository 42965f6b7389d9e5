// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot_groups.h"

#include <algorithm>
#include <set>

#include "robot/urdf_elements.h"

namespace fcl_prob {
namespace {

using detail::UrdfContainer;
using detail::UrdfValues;
using detail::XmlElement;

constexpr int kDeepestGroup = 64;

/// Every joint carries one link: a group is the set of those, by their index in Robot::links().
class GroupReader {
 public:
  GroupReader(const std::string& path, const Robot& robot)
      : path_(path), robot_(robot), root_(detail::readSrdf(path, robot.name())) {
    for (std::size_t i = 0; i < robot.links().size(); ++i) {
      links_[robot.links()[i].name] = i;
      if (i > 0) carried_by_[robot.links()[i].joint] = i;
    }
  }

  RobotGroups read() {
    for (const XmlElement& element : root_.children) {
      if (element.name == "virtual_joint") {
        virtual_.insert(UrdfContainer(path_, element, element.name, {}).text("name"));
      } else if (element.name == "group") {
        const UrdfContainer group(path_, element, "group", {"joint", "link", "chain", "group"});
        const bool is_new = elements_.emplace(group.text("name"), group).second;
        if (!is_new) group.fail("there is another one named " + group.text("name"));
      }
    }
    RobotGroups groups;
    for (const auto& [name, element] : elements_) {
      RobotGroup& group = groups[name];
      const Links& links = linksOf(name, 1);
      for (const std::size_t link : links) group.links.push_back(robot_.links()[link].name);
      for (const RobotJoint& joint : robot_.joints()) {
        if (links.count(carried_by_.at(joint.name)) > 0) group.joints.push_back(joint.name);
      }
    }
    for (const XmlElement& element : root_.children) {
      if (element.name == "group_state") readState(element, groups);
    }
    return groups;
  }

 private:
  using Links = std::set<std::size_t>;
  using LinksByName = std::map<std::string, std::size_t>;

  /// Kept, since a group may be part of many.
  const Links& linksOf(const std::string& name, int depth) {
    const auto known = known_.find(name);
    if (known != known_.end()) return known->second;
    const UrdfContainer& group = elements_.at(name);
    if (depth > kDeepestGroup) group.fail(name + " is nested too deeply, or within itself");
    Links links;
    for (const XmlElement* element : group.all("joint")) {
      const UrdfValues joint(path_, *element, "group " + name + ": joint", {"name"});
      if (virtual_.count(joint.text("name")) == 0) links.insert(linkIn(carried_by_, joint));
    }
    for (const XmlElement* element : group.all("link")) {
      links.insert(linkIn(links_, {path_, *element, "group " + name + ": link", {"name"}}));
    }
    for (const XmlElement* element : group.all("chain")) {
      links.merge(
          chainOf({path_, *element, "group " + name + ": chain", {"base_link", "tip_link"}}));
    }
    for (const XmlElement* element : group.all("group")) {
      const UrdfValues other(path_, *element, "group " + name + ": group", {"name"});
      if (elements_.count(other.text("name")) == 0) other.fail("no group " + other.text("name"));
      const Links& more = linksOf(other.text("name"), depth + 1);
      links.insert(more.begin(), more.end());
    }
    return known_[name] = std::move(links);
  }

  std::size_t linkIn(const LinksByName& known, const UrdfValues& values,
                     const char* attribute = "name") const {
    const auto found = known.find(values.text(attribute));
    if (found != known.end()) return found->second;
    values.fail(robot_.name() + (&known == &links_ ? " has no link " : " has no joint ") +
                values.text(attribute));
  }

  /// What is on the way to the root from one of the ends only.
  Links chainOf(const UrdfValues& chain) const {
    Links links;
    for (const char* end : {"base_link", "tip_link"}) {
      for (std::size_t link = linkIn(links_, chain, end); link > 0;) {
        if (!links.insert(link).second) links.erase(link);
        link = static_cast<std::size_t>(robot_.links()[link].parent);
      }
    }
    return links;
  }

  void readState(const XmlElement& element, RobotGroups& groups) const {
    const UrdfContainer state(path_, element, "group_state", {"joint"});
    const std::string &name = state.text("name"), &of = state.text("group");
    if (groups.count(of) == 0) state.fail(name + " is of no group: " + of);
    const auto& moving = groups[of].joints;
    const auto [values, is_new] = groups[of].states.try_emplace(name);
    if (!is_new) state.fail("there is another one named " + name + " of the group " + of);
    for (const XmlElement* one : state.all("joint")) {
      const UrdfValues told(path_, *one, "group_state " + name + ": joint", {"name", "value"});
      const std::string& joint = told.text("name");
      if (virtual_.count(joint) > 0) continue;
      if (known_.at(of).count(linkIn(carried_by_, told)) == 0) {
        told.fail(std::string("no joint of group ").append(of).append(": ").append(joint));
      }
      const double value = told.number("value");
      if (std::find(moving.begin(), moving.end(), joint) == moving.end()) continue;
      if (!values->second.emplace(joint, value).second) told.fail(joint + " is there twice");
    }
  }

  const std::string& path_;
  const Robot& robot_;
  const XmlElement root_;
  LinksByName links_;
  LinksByName carried_by_;  ///< by the names of joints
  std::set<std::string> virtual_;
  std::map<std::string, UrdfContainer> elements_;
  std::map<std::string, Links> known_;
};

}  // namespace

RobotGroups loadGroups(const std::string& srdf_file, const Robot& robot) {
  return GroupReader(srdf_file, robot).read();
}

}  // namespace fcl_prob
