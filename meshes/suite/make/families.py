# SPDX-License-Identifier: MIT
"""All families, in the order of their names."""

import balls
import manifolds
import page
import solids

ALL = page.FAMILIES + balls.FAMILIES + manifolds.FAMILIES + solids.FAMILIES
