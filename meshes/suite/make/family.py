# SPDX-License-Identifier: MIT
"""A fixture file: its name, what it shows, where it is from, and what makes its cases."""

from dataclasses import dataclass
from typing import Callable


@dataclass
class Family:
    name: str
    shows: str
    source: str
    cases: Callable
    slow: bool = False
