# SPDX-License-Identifier: MIT
"""JSON that is compact and can still be read: what fits on a line stands on one, lists are filled
like text."""

import json

WIDTH = 100


def flat(value):
    """Whole numbers without a fraction: 1.0 is 1 in JSON as well."""
    if isinstance(value, float):
        return str(int(value)) if value == int(value) else repr(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)}: {flat(v)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flat, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def is_small(value):
    """Things that several stand of on a line: points, tetrahedra, splits."""
    return not isinstance(value, (dict, list, tuple)) or len(flat(value)) < 72 and not (
        isinstance(value, dict) and ("after" in value or "body" in value))


def filled(words, inner):
    lines = [inner]
    for word in words:
        if len(lines[-1]) + len(word) + 1 > WIDTH and lines[-1] != inner:
            lines[-1] = lines[-1].rstrip()
            lines.append(inner)
        lines[-1] += word + ", "
    lines[-1] = lines[-1].rstrip()[:-1]
    return lines


def lines_of(value, indent, room):
    text = flat(value)
    if len(text) <= room or not isinstance(value, (dict, list, tuple)):
        return [text]
    inner = " " * (indent + 1)
    if isinstance(value, dict) and not any(isinstance(v, (dict, list)) for v in value.values()):
        words = [f"{json.dumps(key)}: {flat(item)}" for key, item in value.items()]
        return ["{"] + filled(words, inner) + [" " * indent + "}"]
    if isinstance(value, dict):
        lines = []
        for key, item in value.items():
            name = json.dumps(key) + ": "
            sub = lines_of(item, indent + 1, WIDTH - len(inner) - len(name) - 1)
            lines += [inner + name + sub[0]] + sub[1:]
            lines[-1] += ","
        lines[-1] = lines[-1][:-1]
        return ["{"] + lines + [" " * indent + "}"]
    if all(map(is_small, value)):
        return ["["] + filled(map(flat, value), inner) + [" " * indent + "]"]
    lines = []
    for item in value:
        sub = lines_of(item, indent + 1, WIDTH - len(inner) - 1)
        lines += [inner + sub[0]] + sub[1:]
        lines[-1] += ","
    lines[-1] = lines[-1][:-1]
    return ["["] + lines + [" " * indent + "]"]


def text_of(value):
    return "\n".join(lines_of(value, 0, 0)) + "\n"
