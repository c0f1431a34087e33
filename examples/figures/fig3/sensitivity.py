#!/usr/bin/env python3
"""Sensitivity of Fig. 3 to the modelling choices: one Markdown table from the folder of `suture sweep sensitivity.toml`.

    sensitivity.py FOLDER

Per node: healed shape with its standard error over the seeds, t_50 and t_05 of the seed-averaged wound (what is left at the end in
per cent, in brackets, where it never falls to 5 %). A star marks a shape that is more than two standard errors of the difference
away from that of the row "printed"."""
import math
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import read, select


def shape(row, printed):
    if row["healed_shape_sem"] == "" or printed["healed_shape_sem"] == "":
        return f"{row['healed_shape_mean']:.3f}"
    text = f"{row['healed_shape_mean']:.3f} ± {row['healed_shape_sem']:.3f}"
    error = math.hypot(row["healed_shape_sem"], printed["healed_shape_sem"])
    return text + (" *" if row is not printed and abs(row["healed_shape_mean"] - printed["healed_shape_mean"]) > 2 * error else "")


def times(row):
    half = f"{row['t_50_of_mean']:.0f}" if row["t_50_of_mean"] != "" else "-"
    end = f"{row['t_05_of_mean']:.0f}" if row["t_05_of_mean"] != "" else f"({100 * row['end_fraction_of_mean']:.0f} %)"
    return f"{half} / {end}"


def main():
    rows = [row for row in read(pathlib.Path(sys.argv[1]) / "nodes.csv") if row["runs"] > 0]
    nodes = list(dict.fromkeys((row["area.stiffness"], row["plasticity.tau"]) for row in rows))
    print("| choice | runs | " + " | ".join(f"k_a {k:g}, tau {tau:g}: shape | t_50 / t_05" for k, tau in nodes) + " |")
    print("|---|---|" + "---|---|" * len(nodes))
    for case in dict.fromkeys(row["case"] for row in rows):
        cells, runs = [], []
        for k, tau in nodes:
            at_node = {"area.stiffness": k, "plasticity.tau": tau}
            row = (select(rows, case=case, **at_node) or [None])[0]
            runs.append(f"{row['runs']:.0f}" if row else "0")
            cells += [shape(row, select(rows, case="printed", **at_node)[0]), times(row)] if row else ["", ""]
        print(f"| {case} | {'+'.join(runs)} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
