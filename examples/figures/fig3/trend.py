#!/usr/bin/env python3
"""Slopes of healed shape and ln closure rate against ln k_a at every tau, with standard errors, over all runs of a Fig. 3 sweep.

    trend.py FOLDER      a folder of `suture sweep`
"""
import csv
import pathlib
import sys

import numpy as np


def slope(x, y):
    if len(x) < 4 or len(set(x)) < 3:
        return "too few runs"
    design = np.vstack([x, np.ones(len(x))]).T
    coefficients = np.linalg.lstsq(design, np.array(y), rcond=None)[0]
    variance = np.sum((y - design @ coefficients) ** 2) / (len(x) - 2)
    error = np.sqrt(variance * np.linalg.inv(design.T @ design)[0, 0])
    return f"{coefficients[0]:+.4f} +- {error:.4f} ({len(x)} runs)"


def main():
    with open(pathlib.Path(sys.argv[1]) / "sweep.csv", newline="") as stream:
        runs = [row for row in csv.DictReader(stream) if row["status"] in ("closed", "reached_t_end")]
    for tau in sorted({float(row["plasticity.tau"]) for row in runs}):
        at_tau = [row for row in runs if float(row["plasticity.tau"]) == tau]
        shapes = [row for row in at_tau if row["healed_shape"]]
        rates = [row for row in at_tau if row["closure_rate"] and float(row["closure_rate"]) > 0]
        stiffness = lambda rows: [np.log(float(row["area.stiffness"])) for row in rows]
        print(f"tau {tau:9.1f}  shape {slope(stiffness(shapes), [float(r['healed_shape']) for r in shapes])}  "
              f"ln rate {slope(stiffness(rates), [np.log(float(r['closure_rate'])) for r in rates])}")


if __name__ == "__main__":
    main()
