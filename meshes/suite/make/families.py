# SPDX-License-Identifier: MIT
"""All families, in the order of their names."""

import balls
import manifolds
import page

ALL = page.FAMILIES + balls.FAMILIES + manifolds.FAMILIES
