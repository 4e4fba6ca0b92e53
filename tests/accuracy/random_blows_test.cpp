// SPDX-License-Identifier: MIT
// Windows by energy: nothing breaks for which none opened.
#include <catch2/catch.hpp>

#include "tests/experiments/cases/random_blows.hpp"

TEST_CASE("what breaks under random blows had an impact window by energy", "[accuracy][impact]") {
  const sunder::accuracy::BlowCounts counts = sunder::accuracy::run_blows(0, 100);
  CHECK(counts.missed == 0);
  // Both sides of the bound are there.
  CHECK(counts.broke > 2);
  CHECK(counts.spared > 2);
  CHECK(counts.spared_by_pair > 0);
  CHECK(counts.spared_by_island > 0);
}

TEST_CASE("what is certified as rubble does not break, stepped in full", "[accuracy][rubble]") {
  const sunder::accuracy::CertificateCounts counts = sunder::accuracy::run_certificates(0, 250);
  CHECK(counts.missed == 0);
  CHECK(counts.certified > 15);
  CHECK(counts.refused > 15);
  CHECK(counts.needless < counts.refused);
}
