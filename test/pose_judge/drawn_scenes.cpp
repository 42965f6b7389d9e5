// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <array>
#include <cmath>
#include <stdexcept>

#include "families.h"

namespace fcl_prob_judge {
namespace {

struct Family {
  const char* name;
  Draft (*draw)(RandomBodies&);
};

constexpr std::array<Family, 9> kFamilies{{{"ball", leverBeforeBall},
                                           {"wall", leverBeforeWall},
                                           {"between", leverBetweenBalls},
                                           {"several", leverOfSeveral},
                                           {"levers", leverBesideLever},
                                           {"boxes", boxBesideBox},
                                           {"box_wall", boxBeforeWall},
                                           {"arm", armBeforeObstacle},
                                           {"base", armOnBase}}};

/// Coprime with the number of scenes, and so that every family has small and large P's.
constexpr int kStride = 17;

/// Scenes of a family that are drawn until one can have the P that is wanted.
constexpr int kTrials = 60;

}  // namespace

JudgedScene drawnScene(unsigned seed, int index) {
  RandomBodies random(1000 * seed + static_cast<unsigned>(index));
  const double most = logOdds(0.9999);
  const int stratum = kStride * index % kDrawnScenes;
  for (int trial = 0; trial < 1000; ++trial) {
    // Some families have no P near 1: then it is the next one's turn.
    const Family& family =
        kFamilies[static_cast<std::size_t>(index + trial / kTrials) % kFamilies.size()];
    const double odds = most * (2.0 * (stratum + random.uniform(0.0, 1.0)) / kDrawnScenes - 1.0);
    std::optional<JudgedScene> scene = sized(family.draw(random), 1.0 / (1.0 + std::exp(-odds)));
    if (!scene) continue;
    scene->findTruth();
    // Rough truths of what is not smooth may be off.
    if (std::fabs(logOdds(scene->truth) - odds) > 0.3) continue;
    scene->name =
        "drawn_" + std::string(index < 10 ? "0" : "") + std::to_string(index) + "_" + family.name;
    return *scene;
  }
  throw std::runtime_error("no scene can be drawn");
}

}  // namespace fcl_prob_judge
