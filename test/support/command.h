// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Running the fcl_prob command from a test.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace fcl_prob_test {

struct CommandResult {
  int exit_code = -1;  ///< -1 if it was killed by a signal
  std::string out;
  std::string err;

  /// Nothing on stdout, one line on stderr, exit code 2: how every bad input ends.
  bool refused() const {
    return exit_code == 2 && out.empty() && !err.empty() && err.find('\n') == err.size() - 1;
  }
};

/// The command of the build that the tests are run for.
inline std::string commandPath() {
  const char* path = std::getenv("FCL_PROB_CLI");
  return path ? path : FCL_PROB_CLI;
}

inline std::string readWhole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Runs fcl_prob with these arguments in `folder`, after the shell's command `before`. Standard
/// output goes to the file or the descriptor ("&5") `out_path` if given.
inline CommandResult runCommandIn(const std::string& before,
                                  const std::vector<std::string>& arguments,
                                  const TemporaryFolder& folder, const std::string& out_path = "") {
  const std::string out = out_path.empty() ? folder.path("stdout") : out_path;
  std::string line = "cd '" + folder.path("") + "' && " + before + " && '" + commandPath() + "'";
  for (const std::string& argument : arguments) line += " '" + argument + "'";
  line += out[0] == '&' ? " >" + out : " >'" + out + "'";
  line += " 2>'" + folder.path("stderr") + "'";
  const int status = std::system(line.c_str());
  CommandResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (out_path.empty()) result.out = readWhole(out);
  result.err = readWhole(folder.path("stderr"));
  return result;
}

inline CommandResult runCommand(const std::vector<std::string>& arguments,
                                const TemporaryFolder& folder, const std::string& out_path = "") {
  return runCommandIn("true", arguments, folder, out_path);
}

inline std::string dataFile(const std::string& name) {
  return std::string(FCL_PROB_SOURCE_DIR) + "/data/" + name;
}

}  // namespace fcl_prob_test
