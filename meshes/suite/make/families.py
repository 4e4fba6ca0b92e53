# SPDX-License-Identifier: MIT
"""All families, in the order of their names."""

import balls
import cracks
import defective
import large
import manifolds
import page
import solids
import turned

ALL = (page.FAMILIES + balls.FAMILIES + manifolds.FAMILIES + solids.FAMILIES
       + defective.FAMILIES + turned.FAMILIES + cracks.FAMILIES + large.FAMILIES)
assert [family.name.split("-")[0] for family in ALL] == sorted(
    family.name.split("-")[0] for family in ALL)
