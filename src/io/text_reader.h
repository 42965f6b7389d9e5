// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Lines, words and numbers of a text that is already in memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fcl_prob::detail {

/// Walks over the lines of a text, which end in a line feed, a carriage return or both.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}

  /// The next line, or nothing at the end of the text.
  std::optional<std::string_view> next();

  /// Number of the line that next() returned last, from 1.
  std::size_t lineNumber() const { return line_number_; }

  /// Where the line after it begins.
  std::size_t position() const { return position_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t line_number_ = 0;
};

/// The words of a line, separated by blanks or tabs.
std::vector<std::string_view> splitWords(std::string_view line);

/// The same into memory that is kept.
void splitWords(std::string_view line, std::vector<std::string_view>& words);

/// `line` up to a word that begins with '#'. (Within a word it is none: Windows writes 1.#QNAN.)
std::string_view withoutComment(std::string_view line);

/// `text` without the byte order mark that some editors put before UTF-8.
std::string_view withoutByteOrderMark(std::string_view text);

/// `word` in quotation marks for a message: what cannot be printed is escaped, what is long is cut.
std::string inQuotes(std::string_view word);

/// A number that is the whole of `word`; a leading plus sign, "nan" and "inf" are accepted. Numbers
/// beyond the range of double become infinite or zero.
std::optional<double> parseNumber(std::string_view word);

/// An integer that is the whole of `word` and fits.
std::optional<long long> parseInteger(std::string_view word);

}  // namespace fcl_prob::detail
