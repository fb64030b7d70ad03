"""Writes FAMILY.json: numbers of random models, and how they move.

    python generate.py            # the stored files
    python generate.py blocks 5   # one family, so many models, to standard output
"""

import json
import random
import sys
from multiprocessing import Pool
from pathlib import Path

from families import INTEGRATED, rounded
from simulator import NoState, SeveralStates, Simulator, Singular

HERE = Path(__file__).parent
COUNT = 40
RTOL = 1e-12


def motion(family, seed, rtol=RTOL, steps=1):
    """One model of the family: {seed, parameters, joints, last, rate} or {seed, parameters, left_out}; in steps that are so many times shorter."""
    numbers = rounded(family.numbers(random.Random(f"{family.name} {seed}")))
    simulator = Simulator(family.mechanism(numbers))
    simulator.longest_step /= steps
    model = {"seed": seed, "until": family.until(numbers), "parameters": numbers}
    try:
        log, t, y, choices = simulator.run(family.rates(numbers), family.until(numbers), rtol)
    except (NoState, SeveralStates, Singular) as why:
        return model | {"left_out": f"{type(why).__name__} {why}"}
    assert t == model["until"]
    q, v = y.reshape(2, simulator.n, 3)
    places, rates = simulator.sliding(q, v)
    if family.name == "arm":
        places, rates = [q[0, 2], *places], [v[0, 2], *rates]
    # in each joint's list: time, state ("=": sticks; "<" or ">": slides, with the signs of the normal forces in front and behind)
    joints = [[[round(time, 11), state] for time, state in entries] for entries in log]
    last = [[round(float(x), 11), round(float(rate), 10)] for x, rate in zip(places, rates)]
    return model | {"several": choices, "joints": joints, "last": last}


def work(job):
    name, seed = job
    return motion(next(family for family in INTEGRATED if family.name == name), seed)


def written(family, motions):
    lines = ",\n".join(json.dumps(motion, separators=(",", ":")) for motion in motions)
    return f'{{"model":"{family.model}","coordinates":{json.dumps(family.coordinates)},"motions":[\n{lines}\n]}}\n'


def main(names, count, stored):
    for family in INTEGRATED:
        if family.name in names:
            with Pool(2) as pool:
                motions = pool.map(work, [(family.name, seed) for seed in range(count)], chunksize=1)
            text = written(family, motions)
            if stored:
                (HERE / f"{family.name}.json").write_text(text)
            else:
                print(text)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1:2], int(sys.argv[2]), False)
    else:
        main([family.name for family in INTEGRATED], COUNT, True)
