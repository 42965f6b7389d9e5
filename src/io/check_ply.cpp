// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// PLY: the header, then a walk over the body that looks only at list lengths and vertex indices.
#include <iomanip>
#include <sstream>

#include "fcl_prob/exceptions.h"
#include "io/file_checks.h"
#include "io/ply_reader.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

/// More corners than any 32-bit file can index.
constexpr double kLongestList = 4294967295.0;

std::string toText(double number) {
  std::ostringstream text;
  text << std::setprecision(12) << number;
  return text.str();
}

class BodyChecker {
 public:
  BodyChecker(const std::string& path, std::string_view body, const PlyHeader& header)
      : path_(path), header_(header), body_(body, header.encoding) {}

  std::size_t check() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") vertices_ = element.count;
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) checkProperty(element, i, property);
      }
    }
    return triangles_;
  }

 private:
  void checkProperty(const PlyElement& element, std::size_t index, const PlyProperty& property) {
    if (!property.length_type) {
      number(element, index, property.type);
      return;
    }
    const double length = number(element, index, *property.length_type);
    if (!(length >= 0.0 && length <= kLongestList)) {
      fail(element, index, "a list of length " + toText(length));
    }
    const bool face = element.name == "face" &&
                      (property.name == "vertex_indices" || property.name == "vertex_index");
    if (face && length < 3.0) fail(element, index, "a face has fewer than 3 corners");
    if (face) triangles_ += static_cast<std::size_t>(length) - 2;
    for (double k = 0; k < length; ++k) {
      const double value = number(element, index, property.type);
      if (face && !(value >= 0.0 && value < static_cast<double>(vertices_))) {
        fail(element, index,
             "vertex index " + toText(value) + ", but the file has only " +
                 std::to_string(vertices_) + " vertices");
      }
    }
  }

  double number(const PlyElement& element, std::size_t index, PlyType type) {
    const std::optional<double> value = body_.next(type);
    if (!value) fail(element, index, "the data end or are not numbers");
    return *value;
  }

  [[noreturn]] void fail(const PlyElement& element, std::size_t index,
                         const std::string& fault) const {
    throw FileError(path_ + ": " + inQuotes(element.name) + " " + std::to_string(index + 1) +
                    " of " + std::to_string(element.count) + " that the header claims: " + fault);
  }

  const std::string& path_;
  const PlyHeader& header_;
  PlyBodyReader body_;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace

std::size_t checkPly(const std::string& path, std::string_view content) {
  const PlyHeader header = readPlyHeader(path, content);
  return BodyChecker(path, content.substr(header.body), header).check();
}

}  // namespace fcl_prob::detail
