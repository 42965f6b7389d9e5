// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/output.h"

namespace fcl_prob::cli {

std::string onOneLine(const std::string& text) {
  std::string result;
  for (const char character : text) {
    const bool control = static_cast<unsigned char>(character) < 0x20 || character == 0x7f;
    result += control ? ' ' : character;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

void deliver(const std::string& content, const std::string& path) {
  if (path.empty()) {
    detail::writeAll(STDOUT_FILENO, content, "standard output");
  } else {
    writeFile(path, content);
  }
}

}  // namespace fcl_prob::cli
