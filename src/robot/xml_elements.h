// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The elements of a URDF or SRDF with the lines that they begin in (libxml2).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fcl_prob::detail {

/// Of a URDF or SRDF.
inline constexpr std::size_t kMostXmlBytes = std::size_t{16} << 20;

struct XmlAttribute {
  std::string name;  ///< with its prefix; declarations of namespaces are no attributes
  std::string value;
};

struct XmlElement {
  std::string name;       ///< without its prefix
  std::string prefix;     ///< empty: none
  bool of_xacro = false;  ///< by its prefix, or by what that stands for
  long line = 0;          ///< in which it begins, from 1
  bool has_text = false;  ///< other than blanks, between its elements
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;

  std::string fullName() const { return prefix.empty() ? name : prefix + ":" + name; }

  /// \returns null if there is none
  const std::string* attribute(const std::string& wanted) const;
};

/// The root element of a text, which must be `robot`. The text is not trusted: it may have no
/// document type (entities could grow without end), no more than 16 MiB and 64 levels.
/// \param name  of its file, which begins messages \param what  URDF or SRDF, for messages
/// \throws FileError "file: line n: fault"
XmlElement readRobotXml(std::string text, const std::string& name, const std::string& what);

/// That of an SRDF. \throws FileError as readRobotXml(), and for the SRDF of a robot of another
/// name or one that xacro has not been run on
XmlElement readSrdf(const std::string& path, const std::string& robot);

}  // namespace fcl_prob::detail
