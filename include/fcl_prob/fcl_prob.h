// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Everything a user of the query needs.
#pragma once

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
