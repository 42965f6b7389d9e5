// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// PLY: the header, then a walk over the body, element by element.
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "io/mesh_formats.h"
#include "io/ply_reader.h"
#include "io/polygon_mesh.h"
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

/// What an element of the header bears, as far as it matters here.
enum class Bearing { nothing, vertex, face, strips };

struct ElementPlan {
  Bearing bearing = Bearing::nothing;
  int corners = -1;                       ///< which property is the list of vertex indices
  std::array<int, 3> axes{{-1, -1, -1}};  ///< which are x, y and z
};

bool isIndexList(const PlyProperty& property) {
  return property.length_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

class PlyReader {
 public:
  PlyReader(const std::string& path, std::string_view content)
      : path_(path),
        header_(readPlyHeader(path, content)),
        body_(content.substr(header_.body), header_.encoding, header_.lines),
        mesh_(path, 0) {}

  TriangleMesh read() {
    std::vector<ElementPlan> plans;
    for (const PlyElement& element : header_.elements) plans.push_back(planOf(element));
    for (std::size_t k = 0; k < plans.size(); ++k) {
      element_ = &header_.elements[k];
      if (element_->properties.empty()) continue;
      for (ordinal_ = 0; ordinal_ < element_->count; ++ordinal_) {
        readElement(plans[k]);
        if (plans[k].bearing == Bearing::vertex) mesh_.addVertex(checkedVertex());
        if (plans[k].bearing == Bearing::face) addFace();
        if (plans[k].bearing == Bearing::strips) addStrips(plans[k]);
      }
    }
    if (!plans.empty()) end(plans.back());
    return std::move(mesh_).triangulated();
  }

 private:
  // The header.

  ElementPlan planOf(const PlyElement& element) {
    ElementPlan plan;
    if (element.name == "vertex") plan.bearing = Bearing::vertex;
    if (element.name == "face") plan.bearing = Bearing::face;
    if (element.name == "tristrips") plan.bearing = Bearing::strips;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      findRole(element, static_cast<int>(i), plan);
    }
    if (plan.bearing == Bearing::vertex) {
      if (has_vertices_) fail("two elements 'vertex'");
      has_vertices_ = true;
      vertices_ = element.count;
      if (*std::min_element(plan.axes.begin(), plan.axes.end()) < 0) {
        fail("element 'vertex' needs the properties x, y and z");
      }
    } else if (plan.bearing != Bearing::nothing && plan.corners < 0 && element.count > 0) {
      fail("element " + inQuotes(element.name) + " has no list 'vertex_indices'");
    } else if (plan.bearing == Bearing::nothing && plan.corners >= 0 && !isHarmless(element)) {
      fail("element " + inQuotes(element.name) +
           " has vertex indices, but is none of 'face' and 'tristrips'");
    }
    return plan;
  }

  void findRole(const PlyElement& element, int index, ElementPlan& plan) const {
    const PlyProperty& property = element.properties[static_cast<std::size_t>(index)];
    if (isIndexList(property)) {
      if (plan.corners >= 0) fail("element " + inQuotes(element.name) + " has two index lists");
      plan.corners = index;
    }
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (plan.bearing != Bearing::vertex || property.name.size() != 1 || axis > 2) return;
    if (property.length_type || plan.axes[axis] >= 0) {
      fail("element 'vertex' needs one number " + inQuotes(property.name));
    }
    plan.axes[axis] = index;
  }

  /// Indices of texture vertices (MeshLab) and of the samples of a scanner (Stanford).
  static bool isHarmless(const PlyElement& element) {
    return element.count == 0 || element.name == "multi_texture_face" ||
           element.name == "range_grid";
  }

  // The body.

  void readElement(const ElementPlan& plan) {
    for (std::size_t i = 0; i < element_->properties.size(); ++i) {
      const PlyProperty& property = element_->properties[i];
      const int index = static_cast<int>(i);
      if (property.length_type) {
        readList(property, plan.bearing != Bearing::nothing && index == plan.corners);
        continue;
      }
      const double value = number(property.type);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (plan.axes[axis] == index) vertex_[static_cast<int>(axis)] = value;
      }
    }
    if (!body_.isAtEndOfLine()) fail("more on the line than the header tells");
  }

  void readList(const PlyProperty& property, bool is_kept) {
    const double length = number(*property.length_type);
    if (!(length >= 0.0 && length <= kLongestList && length == std::floor(length))) {
      fail("a list of length " + toText(length));
    }
    if (is_kept) list_.clear();
    for (double k = 0; k < length; ++k) {
      const double value = number(property.type);
      if (is_kept) list_.push_back(value);
    }
  }

  double number(PlyType type) {
    const std::optional<double> value = body_.next(type);
    if (!value) fail("the data end or are not numbers");
    return *value;
  }

  fcl::Vector3d checkedVertex() const {
    checkVertex(vertex_, path_, place());
    return vertex_;
  }

  bool isIndex(double value) const {
    return value >= 0.0 && value < static_cast<double>(vertices_) && value == std::floor(value);
  }

  std::size_t indexOf(double value) const {
    if (!isIndex(value)) {
      fail("vertex index " + toText(value) + ", but the file has only " +
           std::to_string(vertices_) + " vertices");
    }
    return static_cast<std::size_t>(value);
  }

  void addFace() {
    if (list_.size() < 3) fail("a face has fewer than 3 corners");
    corners_.clear();
    for (const double value : list_) corners_.push_back(indexOf(value));
    mesh_.addPolygon(corners_, place());
  }

  /// Strips of triangles, each of which shares its first two corners with the one before and turns
  /// the other way; -1 begins the next strip. Triangles with two equal corners join strips.
  void addStrips(const ElementPlan& plan) {
    const PlyType type = element_->properties[static_cast<std::size_t>(plan.corners)].type;
    const double unsigned_end = type == PlyType::uint32   ? 4294967295.0
                                : type == PlyType::uint16 ? 65535.0
                                : type == PlyType::uint8  ? 255.0
                                                          : -1.0;
    std::size_t length = 0;  // of the strip so far
    for (const double value : list_) {
      if (value == -1.0 || (value == unsigned_end && !isIndex(value))) {
        if (length == 1 || length == 2) fail("a strip has fewer than 3 corners");
        length = 0;
        continue;
      }
      corners_.resize(length == 0 ? 0 : corners_.size());
      corners_.push_back(indexOf(value));
      if (++length >= 3)
        addOfStrip(corners_[length - 3], corners_[length - 2], corners_.back(), length);
    }
    if (length == 1 || length == 2) fail("a strip has fewer than 3 corners");
  }

  void addOfStrip(std::size_t a, std::size_t b, std::size_t c, std::size_t length) {
    if (a == b || b == c || c == a) return;
    if (length % 2 == 0) std::swap(a, b);
    mesh_.addPolygon({a, b, c}, place());
  }

  /// What reads as one more face is one that the header does not count.
  void end(const ElementPlan& last) {
    if (body_.isAtEnd()) return;
    const std::string behind = placeText(path_, place());
    const bool bears_surface = last.bearing == Bearing::face || last.bearing == Bearing::strips;
    if (bears_surface && isOneMoreFace(last)) {
      fail("more faces than the header claims");
    }
    mesh_.addNote(behind + ": what is behind the last element is passed over");
  }

  bool isOneMoreFace(const ElementPlan& plan) {
    try {
      readElement(plan);
    } catch (const FileError&) {
      return false;
    }
    const bool may_end = plan.bearing == Bearing::strips;
    return list_.size() >= 3 && std::all_of(list_.begin(), list_.end(), [&](double value) {
             return isIndex(value) || (may_end && value == -1.0);
           });
  }

  FilePlace place() const {
    if (header_.encoding == PlyEncoding::text) return {body_.line(), false};
    return {header_.body + body_.position(), true};
  }

  /// Of the element that is being read; before that, of the header.
  [[noreturn]] void fail(const std::string& fault) const {
    if (element_ == nullptr) throw FileError(path_ + ": the PLY header: " + fault);
    throw FileError(placeText(path_, place()) + ": " + inQuotes(element_->name) + " " +
                    std::to_string(ordinal_ + 1) + " of " + std::to_string(element_->count) +
                    " that the header claims: " + fault);
  }

  const std::string& path_;
  PlyHeader header_;
  PlyBodyReader body_;
  PolygonMesh mesh_;
  bool has_vertices_ = false;
  std::size_t vertices_ = 0;
  const PlyElement* element_ = nullptr;  ///< that is being read
  std::size_t ordinal_ = 0;              ///< of it, from 0
  fcl::Vector3d vertex_;
  std::vector<double> list_;
  std::vector<std::size_t> corners_;
};

}  // namespace

TriangleMesh readPly(const std::string& path, std::string_view content) {
  return PlyReader(path, withoutByteOrderMark(content)).read();
}

}  // namespace fcl_prob::detail
