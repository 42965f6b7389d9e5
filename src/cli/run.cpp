// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/run.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>
#include <sstream>

#include "cli/commands.h"
#include "cli/output.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/version.h"
#include "io/text_reader.h"

namespace fcl_prob::cli {
namespace {

constexpr const char* kFirstSteps =
    "fcl_prob tells how likely it is that two shapes collide. What to try next:\n"
    "  fcl_prob check A.stl B.obj --sigma 0.004,0.003,0.002   two meshes in metres, one answer\n"
    "  fcl_prob check --scene SCENE.json                      the same from a scene file\n"
    "  fcl_prob compare --scene SCENE.json                    every method beside the others\n"
    "  fcl_prob --help, fcl_prob check --help                 all commands; all options of one\n";

int complain(const std::string& message) {
  std::cerr << "fcl_prob: " << onOneLine(message) << std::endl;
  return kBadInput;
}

/// What the first word would have asked for; empty if it is a command of this build, or an option.
std::string unknownCommand(const CLI::App& app, const std::string& word) {
  const auto isWord = [&](const CLI::App* command) { return command->get_name() == word; };
  if (word.empty() || word[0] == '-' || !app.get_subcommands(isWord).empty()) return {};
  for (const auto& [name, part] :
       {std::pair("path", "FCL_PROB_WITH_ROBOT"), std::pair("plan", "FCL_PROB_WITH_PLANNING"),
        std::pair("reconstruct", "FCL_PROB_WITH_CLOUD"),
        std::pair("bench", "FCL_PROB_WITH_BENCH")}) {
    if (word == name) return word + " is not in this build, which has no " + part;
  }
  return "no command " + detail::inQuotes(word) + "; --help lists those there are";
}

int parseAndRun(int argc, const char* const* argv, const std::vector<AddCommand>& others) {
  if (argc < 2) {
    std::cerr << kFirstSteps;
    return kBadInput;
  }
  CLI::App app("Collision probabilities of two shapes under Gaussian position error");
  app.name("fcl_prob");
  app.set_version_flag("--version", "fcl_prob " FCL_PROB_VERSION);
  app.require_subcommand(1);
  int exit_code = kAnswered;
  addCheckCommand(app, exit_code);
  addCompareCommand(app, exit_code);
  addExportCommand(app, exit_code);
  addDecomposeCommand(app, exit_code);
  addSweepCommand(app, exit_code);
#ifdef FCL_PROB_HAS_ROBOT
  addPathCommand(app, exit_code);
#endif
#ifdef FCL_PROB_HAS_PLANNING
  addPlanCommand(app, exit_code);
#endif
#ifdef FCL_PROB_HAS_CLOUD
  addReconstructCommand(app, exit_code);
#endif
  for (const AddCommand add : others) add(app, exit_code);
  const std::string unknown = unknownCommand(app, argv[1]);
  if (!unknown.empty()) return complain(unknown);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) return complain(error.what());
    std::ostringstream text;  // of --help, --version
    app.exit(error, text, std::cerr);
    deliver(text.str(), "");
  }
  return exit_code;
}

}  // namespace

int run(int argc, const char* const* argv, const std::vector<AddCommand>& others) {
  // A closed pipe or a file that may not grow shall be an error message, not a death.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return parseAndRun(argc, argv, others);
  } catch (const std::bad_alloc&) {
    return complain("out of memory");
  } catch (const std::exception& error) {
    return complain(error.what());
  }
}

}  // namespace fcl_prob::cli
