// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Every query that needs no file: of pairs, groups, managers, batches and mixtures; the sampling
// methods and the bounds of convex pairs by themselves; meshes from arrays.
#pragma once

#include "fcl_prob/band.h"
#include "fcl_prob/batch.h"
#include "fcl_prob/broadphase.h"
#include "fcl_prob/certificate.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mixture.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/part_tree.h"
#include "fcl_prob/parts_bounds.h"
#include "fcl_prob/pose_error.h"
#include "fcl_prob/pose_probability.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "fcl_prob/random_configuration.h"
#include "fcl_prob/triangle_mesh.h"
#include "fcl_prob/version.h"
