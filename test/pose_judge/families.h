// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The families that scenes are drawn of.
#pragma once

#include "random_bodies.h"
#include "scene_parts.h"

namespace fcl_prob_judge {

using fcl_prob_test::RandomBodies;

/// Ranks 1 to 3 of the rotation, 0 to 3 of the translation; before a ball.
Draft leverBeforeBall(RandomBodies& random);

/// The same before a half-space or a wide box.
Draft leverBeforeWall(RandomBodies& random);

/// Two balls on either side of the lever, one of which may be rare.
Draft leverBetweenBalls(RandomBodies& random);

/// A lever that is one of several, most of which may miss.
Draft leverOfSeveral(RandomBodies& random);

/// Two levers, each with errors of its own.
Draft leverBesideLever(RandomBodies& random);

/// Two boxes, or their meshes, one of which turns within a plane.
Draft boxBesideBox(RandomBodies& random);

/// A box that turns before a half-space.
Draft boxBeforeWall(RandomBodies& random);

/// The end of a planar arm of 2 to 7 joints before a ball or a half-space.
Draft armBeforeObstacle(RandomBodies& random);

/// The same on a base with an error of any convention.
Draft armOnBase(RandomBodies& random);

/// An angle of some tenths of a degree to some ten degrees.
double drawnAngle(RandomBodies& random);

/// By `sigma`, of a rank and along axes that are drawn.
Translation drawnTranslation(RandomBodies& random, double sigma, int least_rank);

}  // namespace fcl_prob_judge
