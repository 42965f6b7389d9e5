// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <set>

#include "fcl_prob/self_collision.h"
#include "robot/urdf_elements.h"

namespace fcl_prob {
namespace {

using detail::XmlElement;
using NamePair = std::pair<std::string, std::string>;

class SrdfPairs {
 public:
  SrdfPairs(const std::string& path, const Robot& robot) : path_(path), robot_(robot) {}

  std::vector<LinkPair> read() {
    const XmlElement root = detail::readSrdf(path_, robot_.name());
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
    const detail::UrdfContainer told(path_, element, element.name, {});
    const std::string& name = told.text(attribute);
    const auto is_it = [&name](const RobotLink& known) { return known.name == name; };
    if (std::any_of(robot_.links().begin(), robot_.links().end(), is_it)) return name;
    told.fail(robot_.name() + " has no link " + name);
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
