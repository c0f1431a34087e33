#!/usr/bin/env python3
"""Cost of Fig. 3 by node: Markdown tables of rate evaluations (thousands) and wall seconds of a run, means over the seeds.

    cost.py FOLDER       a folder of `suture sweep`

Evaluations do not depend on the machine; seconds do, and on what else it had to do."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import read


def table(runs, title, quantity, scale, digits):
    stiffnesses = sorted({run["area.stiffness"] for run in runs})
    print(f"\n| {title}: tau | " + " | ".join(f"k_a {k:g}" for k in stiffnesses) + " |\n|---|" + "---|" * len(stiffnesses))
    for tau in sorted({run["plasticity.tau"] for run in runs}):
        cells = []
        for k in stiffnesses:
            values = [run[quantity] for run in runs if (run["area.stiffness"], run["plasticity.tau"]) == (k, tau)]
            cells.append(f"{sum(values) / len(values) / scale:.{digits}f}" if values else "")
        print(f"| {tau:g} | " + " | ".join(cells) + " |")


def main():
    runs = [run for run in read(pathlib.Path(sys.argv[1]) / "sweep.csv") if run["status"] in ("closed", "reached_t_end")]
    total = sum(run["wall_s"] for run in runs)
    print(f"{len(runs)} runs, {total / 3600:.2f} h in all, {total / len(runs):.1f} s each on the mean")
    table(runs, "thousand rate evaluations", "rate_evaluations", 1000, 0)
    table(runs, "wall seconds", "wall_s", 1, 1)


if __name__ == "__main__":
    main()
