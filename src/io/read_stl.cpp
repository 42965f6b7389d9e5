// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// STL: binary by its size, otherwise text.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "io/mesh_formats.h"
#include "io/polygon_mesh.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

constexpr std::size_t kHeaderSize = 84;  // 80 bytes of any kind, and the number of triangles
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kNormalSize = 12;

void addTriangle(const std::array<fcl::Vector3d, 3>& corners, TriangleMesh& mesh) {
  const std::size_t first = mesh.vertices.size();
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// Whether `word` is the keyword, in capitals or not.
bool isKeyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char c, char of_keyword) { return (c | 0x20) == of_keyword; });
}

/// Keywords may be in capitals. Facets of any number of solids are one mesh, as two bodies are.
class TextStlReader {
 public:
  TextStlReader(const std::string& path, std::string_view content) : path_(path), lines_(content) {}

  TriangleMesh read() {
    while (const auto line = lines_.next()) {
      place_.position = lines_.lineNumber();
      splitWords(*line, words_);
      for (std::size_t i = 0; i < words_.size();) i += inside_facet_ ? insideFacet(i) : outside(i);
    }
    if (inside_facet_ || !ended_) throw FileError(path_ + ": the STL text ends before 'endsolid'");
    return std::move(mesh_);
  }

 private:
  bool is(std::size_t word, std::string_view keyword) const {
    return isKeyword(words_[word], keyword);
  }

  /// Both read what begins at a word, and return the number of words that it takes.
  std::size_t outside(std::size_t i) {
    const std::size_t rest = words_.size() - i;
    if (is(i, "facet")) {
      inside_facet_ = true;
      corner_count_ = 0;
      return 1;
    }
    for (const char* keyword : {"vertex", "endfacet", "outer", "endloop"}) {
      if (is(i, keyword)) fail(inQuotes(words_[i]) + " outside of a facet");
    }
    if (is(i, "solid") || is(i, "endsolid")) {
      ended_ = is(i, "endsolid");
    } else if (mesh_.notes.empty()) {
      mesh_.notes.push_back(placeText(path_, place_) + ": " + inQuotes(words_[i]) +
                            " is not a keyword of STL: such lines are passed over");
    }
    return rest;  // a name, if anything
  }

  std::size_t insideFacet(std::size_t i) {
    // A normal tells nothing that the corners do not, and not every program has one.
    if (is(i, "normal")) return std::min<std::size_t>(4, words_.size() - i);
    if (is(i, "outer") || is(i, "loop") || is(i, "endloop")) return 1;
    if (is(i, "vertex")) return vertex(i);
    if (is(i, "facet")) fail("a facet begins inside a facet");
    if (!is(i, "endfacet")) fail(inQuotes(words_[i]) + " inside a facet");
    if (corner_count_ != 3) fail("a facet has " + std::to_string(corner_count_) + " vertices");
    addTriangle(corners_, mesh_);
    inside_facet_ = false;
    return 1;
  }

  std::size_t vertex(std::size_t i) {
    if (words_.size() - i < 4) fail("a vertex needs three numbers");
    if (corner_count_ == 3) fail("a facet has more than 3 vertices");
    corners_[corner_count_++] = parseVertex(&words_[i + 1], path_, place_);
    return 4;
  }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError(placeText(path_, place_) + ": " + fault);
  }

  const std::string& path_;
  LineReader lines_;
  FilePlace place_;
  std::vector<std::string_view> words_;
  TriangleMesh mesh_;
  std::array<fcl::Vector3d, 3> corners_;
  std::size_t corner_count_ = 0;
  bool inside_facet_ = false;
  bool ended_ = false;
};

std::array<fcl::Vector3d, 3> cornersAt(std::string_view content, std::size_t position) {
  std::array<float, 9> numbers;
  std::memcpy(numbers.data(), content.data() + position + kNormalSize, sizeof numbers);
  std::array<fcl::Vector3d, 3> corners;
  for (std::size_t i = 0; i < 9; ++i) corners[i / 3][static_cast<int>(i % 3)] = numbers[i];
  return corners;
}

std::uint32_t countAt(std::string_view content, std::size_t header) {
  std::uint32_t count = 0;
  if (content.size() >= header + kHeaderSize) {
    std::memcpy(&count, content.data() + header + kHeaderSize - 4, 4);
  }
  return count;
}

/// Whether bytes behind the last triangle are more triangles, with a header of their own or
/// without: corners that differ, within twice the size of the mesh around it.
bool holdsTriangles(std::string_view content, std::size_t begin, const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : mesh.vertices) box.extend(v);
  if (!mesh.vertices.empty()) {
    const fcl::Vector3d margin = fcl::Vector3d::Constant(2.0 * box.sizes().maxCoeff());
    box = Eigen::AlignedBox3d(box.min() - margin, box.max() + margin);
  }
  for (const std::size_t first : {begin, begin + kHeaderSize}) {
    if (first + kTriangleSize > content.size()) continue;
    const auto [a, b, c] = cornersAt(content, first);
    const bool near =
        mesh.vertices.empty() || (box.contains(a) && box.contains(b) && box.contains(c));
    if (near && a != b && b != c && c != a) return true;
  }
  return false;
}

TriangleMesh readBinary(const std::string& path, std::string_view content) {
  const std::size_t count = countAt(content, 0);
  const std::size_t expected_size = kHeaderSize + kTriangleSize * count;
  const std::string sizes = ": the binary STL header claims " + std::to_string(count) +
                            " triangles, which take " + std::to_string(expected_size) +
                            " bytes, but the file has " + std::to_string(content.size());
  if (content.size() < expected_size) throw FileError(path + sizes);
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t position = kHeaderSize + kTriangleSize * i;
    const std::array<fcl::Vector3d, 3> corners = cornersAt(content, position);
    for (const fcl::Vector3d& corner : corners) checkVertex(corner, path, {position, true});
    addTriangle(corners, mesh);
  }
  if (content.size() > expected_size) {
    if (holdsTriangles(content, expected_size, mesh)) throw FileError(path + sizes);
    mesh.notes.push_back(path + sizes + ": what is behind the last triangle is passed over");
  }
  return mesh;
}

bool isText(std::string_view content) {
  const std::size_t begin = content.find_first_not_of(" \t\r\n");
  return begin != content.npos && content.find('\0') == content.npos &&
         (isKeyword(content.substr(begin, 5), "solid") ||
          isKeyword(content.substr(begin, 5), "facet"));
}

}  // namespace

TriangleMesh readStl(const std::string& path, std::string_view content) {
  const bool whole = content.size() >= kHeaderSize &&
                     content.size() == kHeaderSize + kTriangleSize * countAt(content, 0);
  // Some programs end a text in bytes that are 0.
  std::string_view text = withoutByteOrderMark(content);
  text = text.substr(0, text.find_last_not_of('\0') + 1);
  if (!whole && isText(text)) return TextStlReader(path, text).read();
  if (content.size() < kHeaderSize) {
    throw FileError(path + ": neither a text STL nor a binary one: only " +
                    std::to_string(content.size()) + " bytes");
  }
  return readBinary(path, content);
}

}  // namespace fcl_prob::detail
