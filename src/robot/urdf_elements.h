// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Elements of a URDF, of which nothing that counts may be passed over.
#pragma once

#include <fcl/common/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "robot/xml_elements.h"

namespace fcl_prob::detail {

/// An element that holds others. Ask for what may be in it: whatever else is in it must be known to
/// say nothing of where bodies are. Every member throws FileError "file: line n: name: fault".
class UrdfContainer {
 public:
  /// \param name      in messages: "link hand"
  /// \param expected  names of the elements that are read
  UrdfContainer(const std::string& path, const XmlElement& element, std::string name,
                const std::vector<std::string>& expected);

  /// How messages begin: "arm.urdf: line 12: link hand".
  std::string where() const;

  /// Of an attribute that must be there, and not be empty.
  const std::string& text(const std::string& attribute) const;

  const std::vector<const XmlElement*>& all(const std::string& name) const;

  /// \returns null if there is none. \throws FileError for more than one
  const XmlElement* atMostOne(const std::string& name) const;
  const XmlElement& one(const std::string& name) const;

  [[noreturn]] void fail(const std::string& fault) const;

 private:
  const std::string& path_;
  const XmlElement& element_;
  std::string name_;
  std::map<std::string, std::vector<const XmlElement*>> found_;
};

/// An element whose attributes say where something is or how large: it has these and no others, no
/// text and no elements that are not of a namespace of their own.
class UrdfValues {
 public:
  /// \param name  in messages: "joint wrist: axis"
  UrdfValues(const std::string& path, const XmlElement& element, const std::string& name,
             const std::vector<std::string>& attributes);

  /// How messages begin: "arm.urdf: line 12: joint wrist: axis".
  std::string where() const { return where_; }

  bool has(const std::string& attribute) const { return element_.attribute(attribute) != nullptr; }
  const std::string& text(const std::string& attribute) const;

  /// A finite number; \throws FileError also if it is not there and there is no default.
  double number(const std::string& attribute, std::optional<double> otherwise = {}) const;

  /// The same, > 0.
  double positive(const std::string& attribute) const;

  /// Three finite numbers.
  Eigen::Vector3d vector(const std::string& attribute,
                         std::optional<Eigen::Vector3d> otherwise = {}) const;

  [[noreturn]] void fail(const std::string& fault) const;

 private:
  std::string where_;
  const XmlElement& element_;
};

}  // namespace fcl_prob::detail
