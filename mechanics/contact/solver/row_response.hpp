// SPDX-License-Identifier: MIT
// The solver's own state of each row within one solve: responses, and the disks of friction.
#pragma once

#include <span>

#include "mechanics/contact/solver/contact_rows.hpp"

namespace sunder {

/// The responses of a row, in m/(N s), and the bounds of its friction within the solve.
struct RowResponse {
  Mat3 response = Mat3::Zero();  ///< displacement of side A against B for an impulse of the row
  Mat3 give = Mat3::Zero();      ///< the elastic part of `response`

  // The rest is of contacts only.
  double normal_response = 0;      ///< along the normal, compliance included
  double push_most = 0;            ///< N s: with that pressed, nothing pushes any more
  double tangential_response = 0;  ///< the largest eigenvalue in the contact plane
  double disk = 0;                 ///< N s: most friction in the sweeps at hand
  double disk_change = 0;          ///< N s: by which the disk should have changed last
  double disk_share = 1;           ///< no unit: how much of such a change is made
};

/// One solve: its rows, how each of them responds, and their bodies.
struct RowSolve {
  std::span<Constraint> rows;
  std::span<RowResponse> responses;  ///< one a row
  std::span<RespondingBody> bodies;
  double step;  ///< s
};

/// The 3 x 3 responses of a row; nothing else is filled.
RowResponse own_response(const Constraint& row, std::span<const RespondingBody> bodies,
                         double step);

/// All that a solve of the row begins with. Its disk is the one of the solve before.
RowResponse response_of(const Constraint& row, std::span<const RespondingBody> bodies, double step);

}  // namespace sunder
