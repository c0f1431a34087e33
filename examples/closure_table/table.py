#!/usr/bin/env python3
"""The Markdown table of docs/validation/closure_times.md from the sweep.csv of `suture sweep examples/closure_table/sweep.toml`.

    table.py FOLDER      one line per row: mean +- standard deviation over the seeds
"""
import csv
import pathlib
import statistics
import sys

TIMES = ["t_50", "t_25", "t_10", "t_05"]


def numbers(rows, name):
    return [float(row[name]) for row in rows if row[name] != ""]


def spread(rows, name, digits):
    reached = numbers(rows, name)
    if not reached:
        return "never"
    text = f"{statistics.mean(reached):.{digits}f}"
    if len(reached) > 1:
        text += f" ± {statistics.stdev(reached):.{digits}f}"
    return text if len(reached) == len(rows) else f"{text} ({len(reached)} of {len(rows)})"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: table.py FOLDER")
    folder = pathlib.Path(sys.argv[1])
    with open(folder / "sweep.csv", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["status"] in ("closed", "reached_t_end")]
    for row in rows:
        with open(folder / "runs" / row["run"] / "wound.csv", newline="") as stream:
            row["end_fraction"] = list(csv.DictReader(stream))[-1]["wound_area_fraction"]
    print("| row | seeds | t_50 | t_25 | t_10 | t_05 | A(end)/A_max | healed shape | yields | wall s |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in dict.fromkeys(row["case"] for row in rows):
        these = [row for row in rows if row["case"] == name]
        cells = [spread(these, key, 0) for key in TIMES]
        cells += [spread(these, "end_fraction", 2), spread(these, "healed_shape", 2), spread(these, "yield", 0),
                  spread(these, "wall_s", 0)]
        print(f"| {name} | {len(these)} | " + " | ".join(cells) + " |")


main()
