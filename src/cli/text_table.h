// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Rows of words as text, Markdown and CSV.
#pragma once

#include <string>
#include <vector>

namespace fcl_prob::cli {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : header_(std::move(header)) {}

  /// \param row  as many cells as the header
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  const std::vector<std::string>& header() const { return header_; }
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

  /// Columns padded to the width of their widest cell.
  std::string text() const;

  /// Cells with commas, quotes or line breaks are quoted (RFC 4180).
  std::string csv() const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace fcl_prob::cli
