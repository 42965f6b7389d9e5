// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "verify_check.h"

#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "ask.h"
#include "fcl_prob/certificate.h"

namespace fcl_prob_audit {
namespace {

using Objects = std::vector<fcl::CollisionObjectd>;

// Proofs are what is checked, not how far they go.
constexpr double kTolerance = 0.03;
constexpr std::size_t kMostCells = 2000;

bool mayHaveCertificate(const Scene& scene) {
  const auto isSimple = [](const Member& member) {
    const Kind kind = member.shape.kind;
    const bool is_curved = kind == Kind::ellipsoid || kind == Kind::cone || kind == Kind::cylinder;
    return !is_curved && kind != Kind::halfspace && kind != Kind::plane &&
           member.shape.isOccupied();
  };
  return (scene.question == Question::pair || scene.question == Question::group) &&
         !scene.isMixture() && !scene.truncation && scene.displacements.size() == 1 &&
         std::all_of(scene.a.begin(), scene.a.end(), isSimple) &&
         std::all_of(scene.b.begin(), scene.b.end(), isSimple);
}

Objects objectsOf(const std::vector<Member>& members) {
  Objects objects;
  for (const Member& member : members) {
    objects.emplace_back(makeGeometry(member.shape), member.pose);
  }
  return objects;
}

std::vector<const fcl::CollisionObjectd*> pointersTo(const Objects& objects) {
  std::vector<const fcl::CollisionObjectd*> pointers;
  for (const auto& object : objects) pointers.push_back(&object);
  return pointers;
}

// False where it is refused.
bool writeCertificate(const Scene& scene, const std::string& path) {
  fcl_prob::ProbabilityRequest request = scene.request;
  request.method = fcl_prob::ProbabilityMethod::interval;
  request.relative_tolerance = std::max(request.relative_tolerance, kTolerance);
  request.max_cells = std::min(request.max_cells, kMostCells);
  request.gradient = false;
  request.on_progress = nullptr;
  std::ofstream file(path);
  Answer answer;
  guarded(answer, [&] {
    const Objects a = objectsOf(scene.a), b = objectsOf(scene.b);
    fcl_prob::ProbabilityResult result;
    certifiedProbability(pointersTo(a), pointersTo(b), makeDisplacement(scene.displacements[0]),
                         request, file, result);
    answer.result = result;
  });
  return answer && file.flush();
}

// Its exit code, and what it said.
int run(const std::string& command, std::string& said) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return -1;
  char line[512];
  while (std::fgets(line, sizeof line, pipe)) said += line;
  const int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void checkByVerifier(const Scene& scene, const std::string& verifier, Tally& tally,
                     std::vector<Violation>& found) {
  if (!mayHaveCertificate(scene)) return;
  const std::string path =
      (std::filesystem::temp_directory_path() /
       ("certificate-" + std::to_string(getpid()) + "-" + std::to_string(scene.index) + ".jsonl"))
          .string();
  if (writeCertificate(scene, path)) {
    ++tally.checks["certificate verified"];
    std::string said;
    const int code = run("'" + verifier + "' '" + path + "'", said);
    if (code != 0) {
      found.push_back({"certificate", path + ": exit code " + std::to_string(code) + ": " + said});
      return;  // the file stays
    }
  }
  std::filesystem::remove(path);
}

}  // namespace fcl_prob_audit
