// SPDX-License-Identifier: MIT
// A crack's name.
#pragma once

#include "topology/base/ids.hpp"

namespace sunder {

/// Row of a crack; ids grow and are never reused.
using CrackId = Id<struct CrackTag>;

}  // namespace sunder
