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
      : path_(path), reader_(content) {}

  PlyHeader read() {
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
  LineReader reader_;
  PlyHeader header_;
  bool format_seen_ = false;
};

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
  constexpr std::string_view kSpace = " \t\r\n\v\f";
  position_ = std::min(body_.find_first_not_of(kSpace, position_), body_.size());
  const std::size_t end = std::min(body_.find_first_of(kSpace, position_), body_.size());
  const std::string_view word = body_.substr(position_, end - position_);
  position_ = end;
  return parseNumber(word);
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
