// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "cloud/cloud_files.h"
#include "fcl_prob/exceptions.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

struct Field {
  std::string name;
  std::size_t size = 4;
  char type = 'F';
  std::size_t count = 1;
};

struct PcdHeader {
  std::vector<Field> fields;
  std::size_t width = 0;
  std::size_t height = 1;
  std::size_t points = 0;
  Eigen::Isometry3d viewpoint = Eigen::Isometry3d::Identity();
  std::string encoding;
  std::size_t body = 0;
};

class PcdHeaderReader {
 public:
  PcdHeaderReader(const std::string& path, std::string_view content, const CloudLimits& limits)
      : path_(path), limits_(limits), reader_(content) {}

  PcdHeader read() {
    while (const auto line = reader_.next()) {
      if (!line->empty() && line->front() == '#') continue;
      const std::vector<std::string_view> words = splitWords(*line);
      if (words.empty()) continue;
      statement(words);
      if (words[0] == "DATA") {
        header_.body = reader_.position();
        finish();
        return header_;
      }
    }
    fail("the PCD header has no DATA");
  }

 private:
  using Words = std::vector<std::string_view>;

  void statement(const Words& words) {
    const std::string_view key = words[0];
    if (key == "VERSION") return;
    if (key == "FIELDS" || key == "COLUMNS") {
      for (std::size_t i = 1; i < words.size(); ++i) {
        header_.fields.push_back({std::string(words[i]), 4, 'F', 1});
      }
    } else if (key == "SIZE" || key == "COUNT") {
      ofFields(words, [&](Field& field, std::string_view word) {
        (key == "SIZE" ? field.size : field.count) = count(word, 4096);
      });
    } else if (key == "TYPE") {
      ofFields(words, [&](Field& field, std::string_view word) {
        if (word != "F" && word != "I" && word != "U") fail("TYPE " + inQuotes(word));
        field.type = word[0];
      });
    } else if (key == "WIDTH" || key == "HEIGHT" || key == "POINTS") {
      if (words.size() != 2) fail("not one number");
      const std::size_t value = count(words[1], std::numeric_limits<std::uint32_t>::max());
      (key == "WIDTH" ? header_.width : key == "HEIGHT" ? header_.height : header_.points) = value;
      points_given_ = points_given_ || key == "POINTS";
    } else if (key == "VIEWPOINT") {
      viewpoint(words);
    } else if (key == "DATA" && words.size() == 2) {
      header_.encoding = std::string(words[1]);
    } else {
      fail("not a PCD header line");
    }
  }

  template <typename Set>
  void ofFields(const Words& words, const Set& set) {
    if (words.size() != header_.fields.size() + 1) {
      fail(inQuotes(words[0]) + " has " + std::to_string(words.size() - 1) + " entries for " +
           std::to_string(header_.fields.size()) + " fields");
    }
    for (std::size_t i = 0; i < header_.fields.size(); ++i) set(header_.fields[i], words[i + 1]);
  }

  std::size_t count(std::string_view word, long long most) const {
    const std::optional<long long> value = parseInteger(word);
    if (!value || *value < 0 || *value > most) fail(inQuotes(word) + " is not a count");
    return static_cast<std::size_t>(*value);
  }

  void viewpoint(const Words& words) {
    std::array<double, 7> numbers{};
    if (words.size() != 8) fail("VIEWPOINT needs 7 numbers");
    for (std::size_t i = 0; i < 7; ++i) {
      const std::optional<double> number = parseNumber(words[i + 1]);
      if (!number || !std::isfinite(*number)) fail("VIEWPOINT: " + inQuotes(words[i + 1]));
      numbers[i] = *number;
    }
    Eigen::Quaterniond rotation(numbers[3], numbers[4], numbers[5], numbers[6]);
    if (!(rotation.norm() > 1e-6 && rotation.norm() < 1e6)) fail("VIEWPOINT has no rotation");
    header_.viewpoint.linear() = rotation.normalized().toRotationMatrix();
    header_.viewpoint.translation() = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  }

  void finish() const {
    if (header_.width == 0 || header_.height == 0) fail("the header promises no points");
    if (header_.width > limits_.points / header_.height) {
      fail("the header promises " + std::to_string(header_.width) + " x " +
           std::to_string(header_.height) + " points, more than " + std::to_string(limits_.points));
    }
    if (points_given_ && header_.points != header_.width * header_.height) {
      fail("POINTS is " + std::to_string(header_.points) + ", not WIDTH times HEIGHT");
    }
  }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError(path_ + ": line " + std::to_string(reader_.lineNumber()) + ": " + fault);
  }

  const std::string& path_;
  const CloudLimits& limits_;
  LineReader reader_;
  PcdHeader header_;
  bool points_given_ = false;
};

/// Where x, y and z stand among the bytes, or words, of a point.
struct Layout {
  std::array<std::size_t, 3> offsets{};
  std::array<std::size_t, 3> sizes{};
  std::size_t stride = 0;
};

class PcdBody {
 public:
  PcdBody(const std::string& path, const PcdHeader& header, std::string_view body)
      : path_(path), header_(header), body_(body) {}

  std::vector<Eigen::Vector3d> read() {
    const std::size_t count = header_.width * header_.height;
    if (header_.encoding == "ascii") return readText(count);
    if (header_.encoding == "binary") return readBinary(layout(false), body_, count, false);
    if (header_.encoding == "binary_compressed") return readCompressed(count);
    fail("unknown DATA " + inQuotes(header_.encoding));
  }

 private:
  Layout layout(bool in_words) const {
    Layout result;
    std::array<bool, 3> found{};
    for (const Field& field : header_.fields) {
      for (std::size_t k = 0; k < 3; ++k) {
        constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
        if (field.name != kNames[k]) continue;
        if (found[k]) fail(std::string("two fields ") + kNames[k]);
        if (field.type != 'F' || (field.size != 4 && field.size != 8) || field.count != 1) {
          fail(std::string("field ") + kNames[k] + " is no float or double");
        }
        found[k] = true;
        result.offsets[k] = result.stride;
        result.sizes[k] = field.size;
      }
      result.stride += in_words ? field.count : field.size * field.count;
    }
    if (!found[0] || !found[1] || !found[2]) fail("no fields x, y and z");
    return result;
  }

  std::vector<Eigen::Vector3d> readText(std::size_t count) const {
    const Layout words = layout(true);
    // A point of n words takes 2n - 1 characters and a line feed.
    if (count > body_.size() / (2 * words.stride) + 1) endsEarly();
    std::vector<Eigen::Vector3d> points;
    points.reserve(count);
    LineReader reader(body_);
    while (points.size() < count) {
      const auto line = reader.next();
      if (!line) endsEarly();
      const std::vector<std::string_view> numbers = splitWords(*line);
      if (numbers.empty()) continue;
      if (numbers.size() != words.stride)
        fail("point " + std::to_string(points.size() + 1) + " has " +
             std::to_string(numbers.size()) + " words");
      Eigen::Vector3d point;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::optional<double> number = parseNumber(numbers[words.offsets[k]]);
        if (!number) fail(inQuotes(numbers[words.offsets[k]]) + " is not a number");
        point[static_cast<int>(k)] = *number;
      }
      points.push_back(point);
    }
    return points;
  }

  /// \param by_field  all of one field after the other, as compressed data have it
  std::vector<Eigen::Vector3d> readBinary(const Layout& bytes, std::string_view data,
                                          std::size_t count, bool by_field) const {
    if (count > data.size() / std::max<std::size_t>(bytes.stride, 1)) endsEarly();
    std::vector<Eigen::Vector3d> points(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = by_field ? bytes.offsets[k] * count + bytes.sizes[k] * i
                                        : bytes.stride * i + bytes.offsets[k];
        points[i][static_cast<int>(k)] = number(data.data() + at, bytes.sizes[k]);
      }
    }
    return points;
  }

  static double number(const char* data, std::size_t size) {
    if (size == 4) {
      float value;
      std::memcpy(&value, data, sizeof value);
      return static_cast<double>(value);
    }
    double value;
    std::memcpy(&value, data, sizeof value);
    return value;
  }

  std::vector<Eigen::Vector3d> readCompressed(std::size_t count) const {
    std::array<std::uint32_t, 2> sizes{};
    if (body_.size() < sizeof sizes) endsEarly();
    std::memcpy(sizes.data(), body_.data(), sizeof sizes);
    const Layout bytes = layout(false);
    if (sizes[0] > body_.size() - sizeof sizes) endsEarly();
    if (sizes[1] != count * bytes.stride) {
      fail("the compressed data claim " + std::to_string(sizes[1]) +
           " bytes where the header needs " + std::to_string(count * bytes.stride));
    }
    const auto data = decompressLzf(body_.substr(sizeof sizes, sizes[0]), sizes[1]);
    if (!data) fail("the compressed data are broken");
    return readBinary(bytes, *data, count, true);
  }

  [[noreturn]] void endsEarly() const {
    fail("the data end before the " + std::to_string(header_.width * header_.height) +
         " points that the header promises");
  }
  [[noreturn]] void fail(const std::string& fault) const { throw FileError(path_ + ": " + fault); }

  const std::string& path_;
  const PcdHeader& header_;
  std::string_view body_;
};

}  // namespace

PointCloud readPcd(const std::string& path, std::string_view content, const CloudLimits& limits) {
  const PcdHeader header = PcdHeaderReader(path, content, limits).read();
  PointCloud cloud;
  cloud.width = header.width;
  cloud.height = header.height;
  cloud.sensor = header.viewpoint;
  cloud.points = PcdBody(path, header, content.substr(header.body)).read();
  return cloud;
}

}  // namespace fcl_prob::detail
