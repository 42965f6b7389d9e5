// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// PLY files, element by element.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fcl_prob::detail {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> length_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  std::size_t body = 0;   ///< where the data begin
  std::size_t lines = 0;  ///< of the header itself
};

/// \throws FileError that begins with `path` and the line
PlyHeader readPlyHeader(const std::string& path, std::string_view content);

/// Hands out the numbers of the body one after the other, as doubles (every integer type fits).
class PlyBodyReader {
 public:
  PlyBodyReader(std::string_view body, PlyEncoding encoding, std::size_t header_lines = 0)
      : body_(body), encoding_(encoding), line_(header_lines + 1) {}

  /// Nothing when the body has ended or (text) holds something that is not a number.
  std::optional<double> next(PlyType type) {
    return encoding_ == PlyEncoding::text ? nextWord() : nextBinary(type);
  }

  /// The line of the last number, in a text; bytes that have been read, in a binary body.
  std::size_t line() const { return line_; }
  std::size_t position() const { return position_; }

  /// Whether nothing but blanks follows the last number on its line. True of a binary body.
  bool isAtEndOfLine() const;

  /// Whether nothing is left, or (text) nothing but white space.
  bool isAtEnd() const;

 private:
  std::optional<double> nextWord();
  std::optional<double> nextBinary(PlyType type);

  std::string_view body_;
  PlyEncoding encoding_;
  std::size_t position_ = 0;
  std::size_t line_;
};

}  // namespace fcl_prob::detail
