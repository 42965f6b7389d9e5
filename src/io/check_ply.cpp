// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// PLY: the header, then a walk over the body that looks only at list lengths and vertex indices.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iomanip>
#include <sstream>

#include "fcl_prob/exceptions.h"
#include "io/file_checks.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  NumberType type = NumberType::float32;
  std::optional<NumberType> length_type;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t body = 0;  ///< where the data begin
};

std::optional<NumberType> numberType(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<NumberType>(i);
  }
  return std::nullopt;
}

std::size_t sizeOf(NumberType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

class HeaderReader {
 public:
  HeaderReader(const std::string& path, std::string_view content) : path_(path), reader_(content) {}

  Header read() {
    if (reader_.next() != std::string_view("ply")) fail("a PLY file begins with 'ply'");
    while (const auto line = reader_.next()) {
      const std::vector<std::string_view> words = splitWords(*line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") {
        if (!format_seen_) fail("the PLY header has no format");
        header_.body = reader_.position();
        return header_;
      }
      statement(words);
    }
    fail("the PLY header has no end");
  }

 private:
  void statement(const std::vector<std::string_view>& words) {
    if (words[0] == "format" && words.size() == 3) {
      format(words[1]);
    } else if (words[0] == "element" && words.size() == 3) {
      const std::optional<long long> count = parseInteger(words[2]);
      if (!count || *count < 0) fail(inQuotes(words[2]) + " is not a count");
      header_.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
    } else if (words[0] == "property" && !header_.elements.empty() && words.size() >= 3 &&
               words.size() == (words[1] == "list" ? 5U : 3U)) {
      property(words);
    } else {
      fail("not a PLY header line");
    }
  }

  void format(std::string_view name) {
    if (name == "ascii") {
      header_.encoding = Encoding::text;
    } else if (name == "binary_little_endian") {
      header_.encoding = Encoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = Encoding::big_endian;
    } else {
      fail("unknown PLY format " + inQuotes(name));
    }
    format_seen_ = true;
  }

  void property(const std::vector<std::string_view>& words) {
    Property result;
    result.name = words.back();
    result.type = type(words[words.size() - 2]);
    if (words[1] == "list") result.length_type = type(words[2]);
    header_.elements.back().properties.push_back(result);
  }

  NumberType type(std::string_view name) const {
    const std::optional<NumberType> result = numberType(name);
    if (!result) fail("unknown PLY number type " + inQuotes(name));
    return *result;
  }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError(path_ + ": line " + std::to_string(reader_.lineNumber()) + ": " + fault);
  }

  const std::string& path_;
  LineReader reader_;
  Header header_;
  bool format_seen_ = false;
};

/// Hands out the numbers of the body one after the other, as doubles (every integer type fits).
class BodyReader {
 public:
  BodyReader(std::string_view body, Encoding encoding) : body_(body), encoding_(encoding) {}

  /// Nothing when the body has ended or (text) holds something that is not a number.
  std::optional<double> next(NumberType type) {
    return encoding_ == Encoding::text ? nextWord() : nextBinary(type);
  }

 private:
  std::optional<double> nextWord() {
    constexpr std::string_view kSpace = " \t\r\n\v\f";
    position_ = std::min(body_.find_first_not_of(kSpace, position_), body_.size());
    const std::size_t end = std::min(body_.find_first_of(kSpace, position_), body_.size());
    const std::string_view word = body_.substr(position_, end - position_);
    position_ = end;
    return parseNumber(word);
  }

  std::optional<double> nextBinary(NumberType type) {
    const std::size_t size = sizeOf(type);
    if (body_.size() - position_ < size) return std::nullopt;
    std::array<char, 8> bytes{};
    std::copy_n(body_.data() + position_, size, bytes.begin());
    position_ += size;
    if (encoding_ == Encoding::big_endian) std::reverse(bytes.begin(), bytes.begin() + size);
    return decode(bytes, type);
  }

  template <typename Number>
  static double as(const std::array<char, 8>& bytes) {
    Number value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
  }

  static double decode(const std::array<char, 8>& bytes, NumberType type) {
    switch (type) {
      case NumberType::int8:
        return as<std::int8_t>(bytes);
      case NumberType::uint8:
        return as<std::uint8_t>(bytes);
      case NumberType::int16:
        return as<std::int16_t>(bytes);
      case NumberType::uint16:
        return as<std::uint16_t>(bytes);
      case NumberType::int32:
        return as<std::int32_t>(bytes);
      case NumberType::uint32:
        return as<std::uint32_t>(bytes);
      case NumberType::float32:
        return as<float>(bytes);
      case NumberType::float64:
        return as<double>(bytes);
    }
    return 0.0;
  }

  std::string_view body_;
  Encoding encoding_;
  std::size_t position_ = 0;
};

/// More corners than any 32-bit file can index.
constexpr double kLongestList = 4294967295.0;

std::string toText(double number) {
  std::ostringstream text;
  text << std::setprecision(12) << number;
  return text.str();
}

class BodyChecker {
 public:
  BodyChecker(const std::string& path, std::string_view body, const Header& header)
      : path_(path), header_(header), body_(body, header.encoding) {}

  std::size_t check() {
    for (const Element& element : header_.elements) {
      if (element.name == "vertex") vertices_ = element.count;
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) checkProperty(element, i, property);
      }
    }
    return triangles_;
  }

 private:
  void checkProperty(const Element& element, std::size_t index, const Property& property) {
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

  double number(const Element& element, std::size_t index, NumberType type) {
    const std::optional<double> value = body_.next(type);
    if (!value) fail(element, index, "the data end or are not numbers");
    return *value;
  }

  [[noreturn]] void fail(const Element& element, std::size_t index,
                         const std::string& fault) const {
    throw FileError(path_ + ": " + inQuotes(element.name) + " " + std::to_string(index + 1) +
                    " of " + std::to_string(element.count) + " that the header claims: " + fault);
  }

  const std::string& path_;
  const Header& header_;
  BodyReader body_;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace

std::size_t checkPly(const std::string& path, std::string_view content) {
  const Header header = HeaderReader(path, content).read();
  return BodyChecker(path, content.substr(header.body), header).check();
}

}  // namespace fcl_prob::detail
