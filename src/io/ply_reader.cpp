// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/ply_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "fcl_prob/exceptions.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

std::optional<PlyType> numberType(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<PlyType>(i);
  }
  return std::nullopt;
}

std::size_t sizeOf(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

class PlyHeaderReader {
 public:
  PlyHeaderReader(const std::string& path, std::string_view content)
      : path_(path), content_(content), reader_(content) {}

  PlyHeader read() {
    const auto magic = reader_.next();
    if (!magic || splitWords(*magic) != std::vector<std::string_view>{"ply"}) {
      fail("a PLY file begins with 'ply'");
    }
    // Where lines end in a carriage return alone, a line feed is the first byte of the data.
    const bool returns_only = content_.substr(reader_.position() - 1, 1) == "\r";
    while (const auto line = reader_.next()) {
      const std::vector<std::string_view> words = splitWords(*line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") {
        if (!format_seen_) fail("the PLY header has no format");
        header_.body = reader_.position();
        if (returns_only && content_.substr(header_.body - 2, 2) == "\r\n") --header_.body;
        header_.lines = reader_.lineNumber();
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
      header_.encoding = PlyEncoding::text;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      fail("unknown PLY format " + inQuotes(name));
    }
    format_seen_ = true;
  }

  void property(const std::vector<std::string_view>& words) {
    PlyProperty result;
    result.name = words.back();
    result.type = type(words[words.size() - 2]);
    if (words[1] == "list") result.length_type = type(words[2]);
    header_.elements.back().properties.push_back(result);
  }

  PlyType type(std::string_view name) const {
    const std::optional<PlyType> result = numberType(name);
    if (!result) fail("unknown PLY number type " + inQuotes(name));
    return *result;
  }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError(path_ + ": line " + std::to_string(reader_.lineNumber()) + ": " + fault);
  }

  const std::string& path_;
  std::string_view content_;
  LineReader reader_;
  PlyHeader header_;
  bool format_seen_ = false;
};

bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

template <typename Number>
double as(const std::array<char, 8>& bytes) {
  Number value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value);
}

double decode(const std::array<char, 8>& bytes, PlyType type) {
  switch (type) {
    case PlyType::int8:
      return as<std::int8_t>(bytes);
    case PlyType::uint8:
      return as<std::uint8_t>(bytes);
    case PlyType::int16:
      return as<std::int16_t>(bytes);
    case PlyType::uint16:
      return as<std::uint16_t>(bytes);
    case PlyType::int32:
      return as<std::int32_t>(bytes);
    case PlyType::uint32:
      return as<std::uint32_t>(bytes);
    case PlyType::float32:
      return as<float>(bytes);
    case PlyType::float64:
      return as<double>(bytes);
  }
  return 0.0;
}

}  // namespace

PlyHeader readPlyHeader(const std::string& path, std::string_view content) {
  return PlyHeaderReader(path, content).read();
}

std::optional<double> PlyBodyReader::nextWord() {
  for (; position_ < body_.size() && isSpace(body_[position_]); ++position_) {
    const char space = body_[position_];
    const bool feed_follows = body_.substr(position_ + 1, 1) == "\n";
    if (space == '\n' || (space == '\r' && !feed_follows)) ++line_;
  }
  const std::size_t begin = position_;
  while (position_ < body_.size() && !isSpace(body_[position_])) ++position_;
  return parseNumber(body_.substr(begin, position_ - begin));
}

bool PlyBodyReader::isAtEndOfLine() const {
  if (encoding_ != PlyEncoding::text) return true;
  const std::size_t next = body_.find_first_not_of(" \t\v\f", position_);
  return next == body_.npos || body_[next] == '\n' || body_[next] == '\r';
}

bool PlyBodyReader::isAtEnd() const {
  if (encoding_ != PlyEncoding::text) return position_ == body_.size();
  return std::all_of(body_.begin() + static_cast<std::ptrdiff_t>(position_), body_.end(), isSpace);
}

std::optional<double> PlyBodyReader::nextBinary(PlyType type) {
  const std::size_t size = sizeOf(type);
  if (body_.size() - position_ < size) return std::nullopt;
  std::array<char, 8> bytes{};
  std::copy_n(body_.data() + position_, size, bytes.begin());
  position_ += size;
  if (encoding_ == PlyEncoding::big_endian) std::reverse(bytes.begin(), bytes.begin() + size);
  return decode(bytes, type);
}

}  // namespace fcl_prob::detail
