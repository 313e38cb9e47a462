#!/usr/bin/env python3
"""Writes a scene of random rubble to standard output: blocks, tilted slabs, loose and slippery pieces.

    python3 maps/make_rubble.py NAME LENGTH SEED TIME_LIMIT [--gentle]

The same arguments give the same bytes. Standard library only. Over hundreds of metres rubble as rough as that of the
canned scenes comes, sooner or later, to a place that nobody passes; --gentle makes kilometres that can be walked.
"""
import argparse
import os
import random
import sys

PAD = 1.5  # level ground before and after [m]
ROUGHNESS, GENTLE_ROUGHNESS = 0.14, 0.1  # greatest change of height from vertex to vertex [m]
BLOCK, GENTLE_BLOCK = 0.12, 0.06  # height of an upright edge [m]
LEAST_FRICTION, GENTLE_FRICTION = 0.3, 0.4
NO_HOLD = "foothold: false"
BAND = 0.3  # heights stay within +- this [m]


def profile(length, rng, gentle):
    """Vertices of the rubble and the overrides of its segments, by index."""
    roughness = GENTLE_ROUGHNESS if gentle else ROUGHNESS
    block = GENTLE_BLOCK if gentle else BLOCK
    friction = GENTLE_FRICTION if gentle else LEAST_FRICTION
    since_hard = 0  # pieces since the last upright edge or piece without a hold
    vertices, overrides = [(-PAD, 0.0), (0.0, 0.0)], {}
    x, y = 0.0, 0.0
    while x < length - 0.5:
        upright = vertices[-1][0] == vertices[-2][0]
        may_be_hard = not gentle or since_hard >= 2
        since_hard += 1
        if rng.random() < 0.12 and not upright and may_be_hard:  # a block: straight up or down
            y += block if y < 0 else -block
            since_hard = 0
        else:
            x += 0.15 + 0.3 * rng.random()
            y = min(BAND, max(-BAND, y + roughness * (2 * rng.random() - 1)))
            draw = rng.random()
            if draw < 0.08 and may_be_hard:
                overrides[len(vertices) - 1] = NO_HOLD
                since_hard = 0
            elif draw < 0.3:
                overrides[len(vertices) - 1] = "friction: %.2f" % (friction + 0.6 * rng.random())
        vertices.append((round(x, 3), round(y, 3) + 0.0))
    return vertices + [(length, 0.0), (length + PAD, 0.0)], overrides


def place(x):
    """x to the millimetre."""
    return ("%.3f" % x).rstrip("0").rstrip(".")


def main():
    parser = argparse.ArgumentParser(description="Writes a scene of random rubble to standard output.")
    parser.add_argument("name")
    parser.add_argument("length", type=float, help="of the rubble [m]")
    parser.add_argument("seed", type=int)
    parser.add_argument("time_limit", type=float, help="of the search [s]")
    parser.add_argument("--gentle", action="store_true", help="kilometres that can be walked")
    a = parser.parse_args()
    if not a.length > 0 or not a.time_limit > 0:
        parser.error("LENGTH and TIME_LIMIT are greater than 0")
    if not all(c.isalnum() or c in "_-" for c in a.name) or not a.name:
        parser.error("NAME: expected letters, digits, - and _")
    name, length, time_limit = a.name, a.length, a.time_limit
    vertices, overrides = profile(length, random.Random(a.seed), a.gentle)
    rows = [vertices[i:i + 6] for i in range(0, len(vertices), 6)]
    text = ",\n        ".join(", ".join("[%s, %g]" % (place(v[0]), v[1]) for v in row) for row in rows)
    print("# Exercises: %g m of rubble. Made by: python3 maps/make_rubble.py %s" % (length, " ".join(sys.argv[1:])))
    print("surefoot: 1\nname: %s\nterrain:\n  friction: 0.7\n  chains:\n    - vertices: [\n        %s]" % (name, text))
    print("      segments:")
    for index, override in overrides.items():
        print("        %d: {%s}" % (index, override))
    print("robot: {radius_of_gyration: 0.2, reach: [0.25, 0.95], clearance: 0.15, mass: 12}")
    print("disturbance: {kappa: 0.08, nu: 0.02}")
    print("start:\n  feet: [{x: -0.9}, {x: -0.3}, {x: -0.6}]\n  support: [1, 2]")
    print("goal: {com_x: [%g, %g]}" % (length + 0.4, length + 0.9))
    print("search: {time_limit: %g}" % time_limit)


try:
    main()
    sys.stdout.flush()
except BrokenPipeError:  # whoever read has seen enough
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
