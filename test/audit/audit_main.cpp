// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The audit as a program: scripts/audit runs it, test/audit/README.md tells what it does.
#include <filesystem>
#include <iostream>

#include "audit_run.h"
#include "scene_file.h"
#include "scene_generator.h"

using namespace fcl_prob_audit;

namespace {

struct Arguments {
  AuditPlan plan;
  std::string output = "audit-failures";
  bool shrink = true;
};

Arguments parsed(int argc, char** argv) {
  Arguments arguments;
  AuditPlan& plan = arguments.plan;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--verbose") {
      plan.verbose = true;
      continue;
    }
    if (option == "--no-shrink") {
      arguments.shrink = false;
      continue;
    }
    if (i + 1 >= argc) throw std::invalid_argument(option + " needs a value, or is no option");
    const std::string value = argv[++i];
    if (option == "--seed") {
      plan.seed = std::stoull(value);
    } else if (option == "--scenes") {
      plan.scenes = std::stoull(value);
    } else if (option == "--seconds") {
      plan.seconds = std::stod(value);
    } else if (option == "--first") {
      plan.first = std::stoull(value);
    } else if (option == "--index") {
      plan.first = std::stoull(value);
      plan.scenes = 1;
      plan.verbose = true;
    } else if (option == "--family") {
      plan.family = value;
    } else if (option == "--threads") {
      plan.threads = static_cast<unsigned>(std::stoul(value));
    } else if (option == "--verify") {
      plan.options.verifier = value;
    } else if (option == "--verify-every") {
      plan.options.verify_every = std::stoull(value);
    } else if (option == "--output") {
      arguments.output = value;
    } else {
      throw std::invalid_argument("no option " + option);
    }
  }
  if (!plan.scenes && !plan.seconds) plan.scenes = 1000;
  return arguments;
}

void tellFailures(const AuditReport& report, const Arguments& arguments) {
  std::filesystem::create_directories(arguments.output);
  int number = 0;
  std::string last;
  for (const Failure& failure : report.failures) {
    // One of a kind is made small.
    const std::string kind = failure.scene.family + ": " + failure.violation.check;
    if (kind == last) continue;
    last = kind;
    // What hangs would hang some hundred times.
    const bool shrink = arguments.shrink && failure.violation.check != "hang";
    const Failure small = shrink ? smallest(failure, arguments.plan.options) : failure;
    const std::string name = "failure-" + std::to_string(++number);
    const std::string how = writeScene(small.scene, arguments.output, name,
                                       kind + "\n" + small.violation.detail + "\n");
    std::cout << "\n"
              << kind << "\n  " << small.violation.detail << "\n  " << how << "\n  also "
              << arguments.output << "/" << name << ".txt" << std::endl;
  }
}

int run(const Arguments& arguments) {
  const AuditReport report = runAudit(arguments.plan);
  std::cout << textOf(report) << report.scenes << " scenes in " << report.seconds << " s, seed "
            << arguments.plan.seed << ", from index " << arguments.plan.first << "\n";
  const bool heavy = hasHeavyTails(report.tally);
  if (heavy) std::cout << "VIOLATION: estimates beyond 5 standard errors\n";
  tellFailures(report, arguments);
  return report.failures.empty() && !heavy ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parsed(argc, argv));
  } catch (const std::exception& exception) {
    std::cerr << "audit: " << exception.what() << "\n";
    return 2;
  }
}
