#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# A kernel that is wrong on purpose, in the way named: the judge has to notice.
import sys

import minimal


class Liar(minimal.Kernel):
    """Wrong from the given split on, so that a run shows the step at which it begins."""

    def __init__(self, lie, begins):
        self.lie, self.left = lie, begins

    def split(self, t, opposite):
        self.left -= 1
        lying = self.left < 0
        if lying and self.lie == "hangs":
            sys.stdin.read()
        if lying and self.lie == "dies":
            sys.exit(3)
        if lying and self.lie == "babbles":
            return "I would rather not say"
        if lying and self.lie == "says-twice":
            return super().split(t, opposite) + "\nsplit 0 0 0"
        if lying and self.lie == "never-ends":
            return "split " + "0 " * 1000000
        answer = super().split(t, opposite)
        if lying and self.lie == "forgets-a-vertex" and answer.startswith("split "):
            words = answer.split()
            n = int(words[1])
            if n > 0:
                return " ".join(["split", str(n - 1), *words[3:]])
        if lying and self.lie == "forgets-a-separation":
            return answer[:-1] + "0" if answer.endswith(" 1") else answer
        return answer

    def counts(self):
        answer = super().counts()
        if self.lie == "miscounts" and self.left < 0:
            words = answer.split()
            words[2] = str(int(words[2]) + 1)
            return " ".join(words)
        return answer


if __name__ == "__main__":
    liar = Liar(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    minimal.serve(liar, "liar glue orientable")
