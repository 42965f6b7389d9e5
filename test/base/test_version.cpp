// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The version that CMake writes into a header is that of package.xml.
#include "fcl_prob/version.h"

#include <fstream>
#include <sstream>
#include <string>

#include "catch.h"

TEST_CASE("the header and package.xml have one version") {
  std::ifstream file(FCL_PROB_SOURCE_DIR "/package.xml");
  std::stringstream text;
  text << file.rdbuf();
  CHECK(text.str().find("<version>" FCL_PROB_VERSION "</version>") != std::string::npos);
  const std::string numbers = std::to_string(FCL_PROB_VERSION_MAJOR) + "." +
                              std::to_string(FCL_PROB_VERSION_MINOR) + "." +
                              std::to_string(FCL_PROB_VERSION_PATCH);
  CHECK(numbers == FCL_PROB_VERSION);
}
