// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <set>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/self_collision.h"
#include "io/file_content.h"
#include "robot/urdf_text.h"

namespace fcl_prob {
namespace {

using boost::property_tree::ptree;
using NamePair = std::pair<std::string, std::string>;

class SrdfPairs {
 public:
  SrdfPairs(const std::string& path, const Robot& robot) : path_(path), robot_(robot) {}

  std::vector<LinkPair> read() {
    const std::string text = detail::fileContent(path_, detail::kMostXmlBytes);
    const ptree document = detail::parseXml(text, path_, "SRDF");
    const ptree& root = document.get_child("robot");
    const std::string name = root.get("<xmlattr>.name", "");
    if (name != robot_.name()) {
      throw FileError(path_ + ": robot: its name is " + name + ", not " + robot_.name());
    }
    // What is on by default, before what is on or off by name.
    for (const auto& [tag, element] : root) {
      if (tag == "disable_default_collisions") allowAllOf(link(element, tag, "link"));
    }
    for (const auto& [tag, element] : root) {
      if (tag == "enable_collisions") allowed_.erase(pairOf(element, tag));
    }
    for (const auto& [tag, element] : root) {
      if (tag == "disable_collisions") allowed_.insert(pairOf(element, tag));
    }
    std::vector<LinkPair> pairs;
    for (const auto& [first, second] : allowed_) pairs.push_back({first, second});
    return pairs;
  }

 private:
  static NamePair ordered(const std::string& x, const std::string& y) { return std::minmax(x, y); }

  NamePair pairOf(const ptree& element, const std::string& tag) const {
    return ordered(link(element, tag, "link1"), link(element, tag, "link2"));
  }

  std::string link(const ptree& element, const std::string& tag, const char* attribute) const {
    const auto name = element.get_optional<std::string>(std::string("<xmlattr>.") + attribute);
    if (!name) throw FileError(path_ + ": " + tag + ": has no " + attribute);
    const auto is_it = [&name](const RobotLink& known) { return known.name == *name; };
    if (std::none_of(robot_.links().begin(), robot_.links().end(), is_it)) {
      throw FileError(path_ + ": " + tag + ": " + robot_.name() + " has no link " + *name);
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
