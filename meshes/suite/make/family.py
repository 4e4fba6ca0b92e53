# SPDX-License-Identifier: MIT
"""A fixture file: its name, what it shows, where it is from, and a function that makes its cases."""

from dataclasses import dataclass
from typing import Callable


@dataclass
class Family:
    name: str
    shows: str
    source: str
    cases: Callable
    slow: bool = False
