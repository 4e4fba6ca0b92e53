# SPDX-License-Identifier: MIT
"""Moments of a run, for make.sh.

    python3 moment.py RESULT first_fan SECONDS   the time of the first fan and so many seconds, s
    python3 moment.py RESULT jump                figure 2's jump: with smoothing and without, m
"""
import json
import pathlib
import sys


def main():
    result = pathlib.Path(sys.argv[1])
    if sys.argv[2] == "jump":
        jump = json.loads((result / "report.json").read_text())["display"]["largest_jump"]
        print(f"largest jump of a drawn point: {jump['as_it_is']:.3g} m, smoothed {jump['smoothed']:.3g} m a step")
        return
    for line in (result / "events.jsonl").read_text().splitlines():
        event = json.loads(line)
        if "fan" in event and "time" in event:
            print(event["time"] + float(sys.argv[3]))
            return
    sys.exit("no fan in " + str(result))


if __name__ == "__main__":
    main()
