// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/text_reader.h"

#include <charconv>
#include <limits>

namespace fcl_prob::detail {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view withoutPlus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') {
    word.remove_prefix(1);
  }
  return word;
}

}  // namespace

std::optional<std::string_view> LineReader::next() {
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t end = text_.find('\n', position_);
  std::string_view line = text_.substr(position_, end - position_);
  position_ = end == std::string_view::npos ? text_.size() : end + 1;
  ++line_number_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> splitWords(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = line.find_first_of(kBlanks, begin);
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::string inQuotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  constexpr const char* kHexDigits = "0123456789abcdef";
  std::string result = "'";
  for (const char character : word.substr(0, kLongest)) {
    const auto code = static_cast<unsigned char>(character);
    if (code >= 0x20 && code < 0x7f) {
      result += character;
    } else {
      result.append("\\x").append({kHexDigits[code >> 4], kHexDigits[code & 15]});
    }
  }
  return result + (word.size() > kLongest ? "...'" : "'");
}

std::optional<double> parseNumber(std::string_view word) {
  word = withoutPlus(word);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    const double magnitude = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return word.front() == '-' ? -magnitude : magnitude;
  }
  return value;
}

std::optional<long long> parseInteger(std::string_view word) {
  word = withoutPlus(word);
  long long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace fcl_prob::detail
