// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/text_reader.h"

#include <algorithm>
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
  const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(position_);
  const auto end = std::find_if(begin, text_.end(), [](char c) { return c == '\n' || c == '\r'; });
  const std::string_view line = text_.substr(position_, static_cast<std::size_t>(end - begin));
  position_ += line.size();
  const bool both = text_.substr(position_, 2) == "\r\n";
  position_ = std::min(position_ + (both ? 2 : 1), text_.size());
  ++line_number_;
  return line;
}

std::vector<std::string_view> splitWords(std::string_view line) {
  std::vector<std::string_view> words;
  splitWords(line, words);
  return words;
}

void splitWords(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = line.find_first_of(kBlanks, begin);
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
}

std::string_view withoutComment(std::string_view line) {
  std::size_t mark = line.find('#');
  while (mark != line.npos && mark > 0 && kBlanks.find(line[mark - 1]) == kBlanks.npos) {
    mark = line.find('#', mark + 1);
  }
  return line.substr(0, mark);
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(text.substr(0, kMark.size()) == kMark ? kMark.size() : 0);
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
