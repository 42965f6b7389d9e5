// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// OFF, as Geomview describes it: the header's counts, then one line a vertex and one line a face.
#include "io/mesh_formats.h"
#include "io/polygon_mesh.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

class OffReader {
 public:
  OffReader(const std::string& path, std::string_view content)
      : path_(path), lines_(content), mesh_(path, 0) {}

  TriangleMesh read() {
    header();
    for (long long i = 0; i < vertices_; ++i) vertex(i + 1);
    for (long long i = 0; i < faces_; ++i) {
      need("face " + std::to_string(i + 1) + " of " + std::to_string(faces_));
      if (const auto fault = face()) fail(*fault);
      mesh_.addPolygon(corners_, place_);
    }
    end();
    return std::move(mesh_).triangulated();
  }

 private:
  /// The words of the next line that holds anything but a comment.
  bool next() {
    while (const auto line = lines_.next()) {
      place_.position = lines_.lineNumber();
      splitWords(withoutComment(*line), words_);
      if (!words_.empty()) return true;
    }
    return false;
  }

  void need(const std::string& wanted) {
    if (!next()) throw FileError(path_ + ": the OFF file ends before its " + wanted);
  }

  /// Prefixes say what stands beside the position: ST texture, C colour, N normal, which do not
  /// matter; 4 a weight, by which the position is divided; n that a dimension precedes the counts.
  void header() {
    need("header");
    const std::size_t keyword = words_[0].find("OFF");
    if (keyword == std::string_view::npos) fail("an OFF file begins with 'OFF'");
    const std::string_view prefix = words_[0].substr(0, keyword);
    if (prefix.find_first_not_of("STCN4n") != prefix.npos) {
      fail(inQuotes(prefix) + " is not a prefix of OFF");
    }
    has_weight_ = prefix.find('4') != prefix.npos;
    words_[0].remove_prefix(keyword + 3);
    if (words_[0].empty()) words_.erase(words_.begin());
    if (!words_.empty() && words_[0] == "BINARY") fail("a binary OFF file is not supported");
    if (prefix.find('n') != prefix.npos) dimension();
    if (words_.empty()) need("counts");
    if (words_.size() < 2) fail("the header needs the number of vertices and of faces");
    vertices_ = count(words_[0]);
    faces_ = count(words_[1]);
  }

  void dimension() {
    if (words_.empty()) need("dimension");
    if (words_[0] != "3") fail("vertices of " + inQuotes(words_[0]) + " dimensions, not of 3");
    words_.erase(words_.begin());
  }

  long long count(std::string_view word) const {
    const std::optional<long long> value = parseInteger(word);
    if (!value || *value < 0) fail(inQuotes(word) + " is not a count");
    return *value;
  }

  void vertex(long long ordinal) {
    need("vertex " + std::to_string(ordinal) + " of " + std::to_string(vertices_));
    const std::size_t numbers = has_weight_ ? 4 : 3;
    if (words_.size() < numbers) {
      fail(has_weight_ ? "a vertex needs three numbers and a weight"
                       : "a vertex needs three numbers");
    }
    fcl::Vector3d vertex = parseVertex(words_.data(), path_, place_);
    if (has_weight_) {
      const std::optional<double> weight = parseNumber(words_[3]);
      if (!weight) fail(inQuotes(words_[3]) + " is not a number");
      vertex /= *weight;
      checkVertex(vertex, path_, place_);
    }
    mesh_.addVertex(vertex);
  }

  /// Into corners_, or what is wrong with it. A colour may follow.
  std::optional<std::string> face() {
    const std::optional<long long> corners = parseInteger(words_[0]);
    if (!corners || *corners < 0) return inQuotes(words_[0]) + " is not a count";
    if (*corners < 3) return "a face has " + std::to_string(*corners) + " corners, not 3 or more";
    if (words_.size() - 1 < static_cast<std::size_t>(*corners)) {
      return "a face of " + std::to_string(*corners) + " corners has " +
             std::to_string(words_.size() - 1) + " indices";
    }
    corners_.clear();
    for (std::size_t i = 1; i <= static_cast<std::size_t>(*corners); ++i) {
      const std::optional<long long> index = parseInteger(words_[i]);
      if (!index || *index < 0 || *index >= vertices_) {
        return inQuotes(words_[i]) + " is not the index of one of " + std::to_string(vertices_) +
               " vertices";
      }
      corners_.push_back(static_cast<std::size_t>(*index));
    }
    return std::nullopt;
  }

  /// What reads as one more face is one that the header does not count.
  void end() {
    if (!next()) return;
    if (!face()) fail("one more face than the " + std::to_string(faces_) + " of the header");
    mesh_.addNote(placeText(path_, place_) + ": passed over, as all that is behind the last face");
  }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError(placeText(path_, place_) + ": " + fault);
  }

  const std::string& path_;
  LineReader lines_;
  PolygonMesh mesh_;
  FilePlace place_;
  std::vector<std::string_view> words_;
  std::vector<std::size_t> corners_;
  bool has_weight_ = false;
  long long vertices_ = 0;
  long long faces_ = 0;
};

}  // namespace

TriangleMesh readOff(const std::string& path, std::string_view content) {
  return OffReader(path, withoutByteOrderMark(content)).read();
}

}  // namespace fcl_prob::detail
