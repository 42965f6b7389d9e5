// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <set>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/self_collision.h"
#include "robot/xml_elements.h"

namespace fcl_prob {
namespace {

using detail::XmlElement;
using NamePair = std::pair<std::string, std::string>;

class SrdfPairs {
 public:
  SrdfPairs(const std::string& path, const Robot& robot) : path_(path), robot_(robot) {}

  std::vector<LinkPair> read() {
    const XmlElement root = detail::readRobotXml(path_, "SRDF");
    const std::string* name = root.attribute("name");
    if (name == nullptr || *name != robot_.name()) {
      throw FileError(path_ + ": robot: its name is " + (name == nullptr ? "" : *name) + ", not " +
                      robot_.name());
    }
    for (const XmlElement& element : root.children) {
      if (!element.of_xacro) continue;
      throw FileError(path_ + ": line " + std::to_string(element.line) + ": the element " +
                      element.fullName() + ": xacro has not been run on this file");
    }
    // What is on by default, before what is on or off by name.
    for (const XmlElement& element : root.children) {
      if (element.name == "disable_default_collisions") allowAllOf(link(element, "link"));
    }
    for (const XmlElement& element : root.children) {
      if (element.name == "enable_collisions") allowed_.erase(pairOf(element));
    }
    for (const XmlElement& element : root.children) {
      if (element.name == "disable_collisions") allowed_.insert(pairOf(element));
    }
    std::vector<LinkPair> pairs;
    for (const auto& [first, second] : allowed_) pairs.push_back({first, second});
    return pairs;
  }

 private:
  static NamePair ordered(const std::string& x, const std::string& y) { return std::minmax(x, y); }

  NamePair pairOf(const XmlElement& element) const {
    return ordered(link(element, "link1"), link(element, "link2"));
  }

  std::string link(const XmlElement& element, const char* attribute) const {
    const std::string where =
        path_ + ": line " + std::to_string(element.line) + ": " + element.name;
    const std::string* name = element.attribute(attribute);
    if (name == nullptr) throw FileError(where + ": has no " + attribute);
    const auto is_it = [name](const RobotLink& known) { return known.name == *name; };
    if (std::none_of(robot_.links().begin(), robot_.links().end(), is_it)) {
      throw FileError(where + ": " + robot_.name() + " has no link " + *name);
    }
    return *name;
  }

  void allowAllOf(const std::string& name) {
    for (const RobotLink& other : robot_.links()) {
      if (other.name != name) allowed_.insert(ordered(name, other.name));
    }
  }

  const std::string& path_;
  const Robot& robot_;
  std::set<NamePair> allowed_;
};

}  // namespace

std::vector<LinkPair> loadAllowedPairs(const std::string& srdf_file, const Robot& robot) {
  return SrdfPairs(srdf_file, robot).read();
}

}  // namespace fcl_prob
