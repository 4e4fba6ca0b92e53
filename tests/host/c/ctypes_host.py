# SPDX-License-Identifier: MIT
"""The C library from Python's ctypes: ctypes_host.py LIBRARY SCENE.json EXPECTED_HASH STEPS

Opens a scene file, steps it, and compares the hash of the state with that of another host (in hexadecimal).
"""

import ctypes
import sys

library, scene, expected, steps = sys.argv[1], sys.argv[2], int(sys.argv[3], 16), int(sys.argv[4])
c = ctypes.CDLL(library)


class Finding(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("severity", ctypes.c_uint32), ("code", ctypes.c_char_p),
                ("text", ctypes.c_char_p), ("remedy", ctypes.c_char_p), ("file", ctypes.c_char_p),
                ("line", ctypes.c_uint64), ("count", ctypes.c_uint64),
                ("ids", ctypes.POINTER(ctypes.c_int64)), ("id_count", ctypes.c_uint64)]


c.sunder_open.restype = ctypes.c_void_p
c.sunder_open.argtypes = [ctypes.c_char_p, ctypes.POINTER(ctypes.c_char_p), ctypes.c_uint32]
c.sunder_step.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
c.sunder_hash.argtypes = [ctypes.c_void_p, ctypes.POINTER(ctypes.c_uint64)]
c.sunder_destroy.argtypes = [ctypes.c_void_p]
c.sunder_finding_count.argtypes = [ctypes.c_void_p]
c.sunder_get_finding.argtypes = [ctypes.c_void_p, ctypes.c_uint32, ctypes.POINTER(Finding)]

assert c.sunder_abi() == 1
settings = (ctypes.c_char_p * 1)(b"duration=banana")
assert not c.sunder_open(scene.encode(), settings, 1)
finding = Finding(size=ctypes.sizeof(Finding))
assert c.sunder_finding_count(None) >= 1 and c.sunder_get_finding(None, 0, ctypes.byref(finding)) == 0
assert finding.code == b"wrong_type" and b"duration" in finding.text and finding.remedy, (finding.code, finding.text)

engine = c.sunder_open(scene.encode(), None, 0)
assert engine
for _ in range(steps):
    assert c.sunder_step(engine, None) == 0
state = ctypes.c_uint64()
assert c.sunder_hash(engine, ctypes.byref(state)) == 0
c.sunder_destroy(engine)
assert state.value == expected, f"hash {state.value:016x}, not {expected:016x}"
print(f"ctypes: the same state after {steps} steps, {state.value:016x}")
