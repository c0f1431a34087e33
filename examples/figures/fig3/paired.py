#!/usr/bin/env python3
"""What the published numerics did, wound by wound: a Markdown table of emulation minus printed equations on the same wounds.

    paired.py PRINTED EMULATION [UNTIL]     two folders of `suture sweep` whose wounds were shared (folder `prepared`)

Differences are means over all stiffnesses and common seeds with their standard errors; ln rate over the pairs in which both wounds
fall to 5 % until the time UNTIL (default: ever). Shapes are those at the end of each run, whenever that was."""
import math
import pathlib
import statistics
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import read


def runs(folder):
    return {(r["area.stiffness"], r["plasticity.tau"], r["seed"]): r for r in read(pathlib.Path(folder) / "sweep.csv")}


def difference(values, digits):
    if len(values) < 3:
        return "too few"
    error = statistics.stdev(values) / math.sqrt(len(values))
    return f"{statistics.mean(values):+.{digits}f} ± {error:.{digits}f}"


def main():
    printed, emulation = runs(sys.argv[1]), runs(sys.argv[2])
    until = float(sys.argv[3]) if len(sys.argv) > 3 else math.inf
    common = sorted(printed.keys() & emulation.keys())
    print("| tau | pairs | t_50 | ln rate | healed shape | reach 5 %: printed | emulation |\n|---|---|---|---|---|---|---|")
    for tau in sorted({key[1] for key in common}):
        pairs = [(printed[key], emulation[key]) for key in common if key[1] == tau]

        def reached(run):
            return run["t_05"] != "" and run["t_05"] <= until

        def both(quantity, chosen=lambda run: True):
            return [(p[quantity], e[quantity]) for p, e in pairs if p[quantity] != "" and e[quantity] != "" and chosen(p) and chosen(e)]
        rates = both("closure_rate", reached)
        print(f"| {tau:g} | {len(pairs)} | {difference([e - p for p, e in both('t_50')], 1)} "
              f"| {difference([math.log(e / p) for p, e in rates], 2)} ({len(rates)}) "
              f"| {difference([e - p for p, e in both('healed_shape')], 3)} "
              f"| {sum(reached(p) for p, _ in pairs)} | {sum(reached(e) for _, e in pairs)} |")


if __name__ == "__main__":
    main()
