// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/run.h"

int main(int argc, char* argv[]) { return fcl_prob::cli::run(argc, argv); }
