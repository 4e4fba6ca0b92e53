# SPDX-License-Identifier: MIT
"""All families, in the order of their names."""

import page

ALL = page.FAMILIES
