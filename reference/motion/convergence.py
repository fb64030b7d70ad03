"""Greatest differences of times and places in six models of each family from those at a tolerance of 1e-13 and half the longest step.

    python convergence.py
"""

from families import INTEGRATED
from generate import motion

if __name__ == "__main__":
    for family in INTEGRATED:
        line = []
        best = [motion(family, seed, 1e-13, 2) for seed in range(6)]
        for rtol, longer in ((1e-8, 4), (1e-10, 2), (1e-12, 1)):
            times, places = 0.0, 0.0
            for exact in best:
                found = motion(family, exact["seed"], rtol, 1 / longer)
                for a, b in zip(exact["joints"], found["joints"], strict=True):
                    assert [state for _, state in a] == [state for _, state in b], (family.name, exact["seed"], rtol, a, b)
                    times = max([times] + [abs(x[0] - y[0]) for x, y in zip(a, b)])
                places = max([places] + [abs(x[0] - y[0]) for x, y in zip(exact["last"], found["last"])])
            line.append(f"{rtol:.0e}, {longer} times the step: {times:.0e} s, {places:.0e} m")
        print(f"{family.name:8} " + "; ".join(line), flush=True)
