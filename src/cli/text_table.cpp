// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/text_table.h"

#include <algorithm>

namespace fcl_prob::cli {
namespace {

using Row = std::vector<std::string>;

std::string csvCell(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char character : cell) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

std::string csvLine(const Row& row) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) line += (i > 0 ? "," : "") + csvCell(row[i]);
  return line + '\n';
}

std::string paddedLine(const Row& row, const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) {
    line += row[i];
    if (i + 1 < row.size()) line.append(widths[i] - row[i].size() + 2, ' ');
  }
  return line + '\n';
}

}  // namespace

std::string TextTable::text() const {
  std::vector<std::size_t> widths(header_.size());
  const auto widen = [&](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  };
  widen(header_);
  for (const Row& row : rows_) widen(row);
  std::string result = paddedLine(header_, widths);
  for (const Row& row : rows_) result += paddedLine(row, widths);
  return result;
}

std::string TextTable::csv() const {
  std::string result = csvLine(header_);
  for (const Row& row : rows_) result += csvLine(row);
  return result;
}

}  // namespace fcl_prob::cli
