// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sums over cells of which some were not looked at, against masses that are known.
#include "pose/mass_tree.h"

#include <cmath>

#include "catch.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

struct KnownCell {
  double mass;     ///< of the cell
  double contact;  ///< of it, what collides
  std::size_t in_tree;
};

// Parts in which contact is far likelier, or rarer, than in the whole.
std::vector<KnownCell> dividedCell(RandomBodies& random, const KnownCell& cell, MassTree& tree) {
  const double mass = random.uniform(0.1, 0.9) * cell.mass;
  const double least = std::max(0.0, cell.contact - (cell.mass - mass));
  const double contact = random.uniform(least, std::min(mass, cell.contact));
  std::vector<KnownCell> parts{{mass, contact, 0}, {cell.mass - mass, cell.contact - contact, 0}};
  for (KnownCell& part : parts) part.in_tree = tree.addPart(cell.in_tree, {0.0, part.mass + 1e-15});
  return parts;
}

}  // namespace

TEST_CASE("what is known of a cell says nothing of a part that was not looked at") {
  MassTree tree({0.0, 1.0});
  tree.tighten(0, {0.3, 0.5});
  const std::size_t first = tree.addPart(0, {0.0, 0.5});
  const std::size_t second = tree.addPart(0, {0.0, 0.5});
  tree.tighten(first, {0.01, 0.02});
  CHECK(tree.sum().lower == 0.3);
  CHECK(tree.sum().upper == 0.5);
  tree.tighten(second, {0.3, 0.35});
  CHECK(tree.sum().lower == Approx(0.31));
  CHECK(tree.sum().upper == Approx(0.37));
}

TEST_CASE("a sum over cells holds whichever of them are looked at, and becomes exact") {
  RandomBodies random(3);
  for (int i = 0; i < 200; ++i) {
    MassTree tree({0.0, 1.0});
    const double contact = random.uniform(0.0, 1.0);
    std::vector<KnownCell> leaves{{1.0, contact, 0}};
    for (int k = 0; k < 40; ++k) {
      const auto at =
          static_cast<std::size_t>(random.integer(0, static_cast<int>(leaves.size()) - 1));
      const KnownCell cell = leaves[at];
      leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(at));
      for (const KnownCell& part : dividedCell(random, cell, tree)) {
        leaves.push_back(part);
        const double open = random.uniform(0.0, 0.3) * part.mass;
        if (random.integer(0, 1) == 0) {
          tree.tighten(part.in_tree, {part.contact - open - 1e-15, part.contact + open + 1e-15});
        }
      }
      CHECK(tree.sum().lower <= contact + 1e-12);
      CHECK(tree.sum().upper >= contact - 1e-12);
    }
    for (const KnownCell& leaf : leaves) tree.tighten(leaf.in_tree, {leaf.contact, leaf.contact});
    CHECK(tree.sum().lower == Approx(contact).margin(1e-12));
    CHECK(tree.sum().upper == Approx(contact).margin(1e-12));
  }
}
