#!/usr/bin/env python3
"""Collects the runs of examples/closure_table/run: one line per run (CSV) and one per row (mean +- standard deviation).

    collect.py FOLDER > closure_table.csv       every run
    collect.py FOLDER --table                   Markdown table of the rows
"""
import csv
import json
import pathlib
import statistics
import sys

TIMES = ["t_50", "t_25", "t_10", "t_05"]


def runs(folder):
    for path in sorted(pathlib.Path(folder).glob("*/seed*/summary.json")):
        summary = json.loads(path.read_text())
        with open(path.parent / "wound.csv", newline="") as stream:
            last = list(csv.DictReader(stream))[-1]
        yield {"row": path.parent.parent.name, "seed": summary["seed"], "status": summary["status"],
               **{key: summary[key] for key in TIMES + ["t_closed", "healed_shape", "wound_area_max"]},
               "end_time": float(last["time"]), "end_fraction": float(last["wound_area_fraction"] or 0.0),
               "end_shape": last["mean_shape"], "yields": summary["events"]["yield"],
               "captures": summary["events"]["capture"],
               "rate_evaluations": summary["solver"]["rate_evaluations"], "steps": summary["solver"]["steps"],
               "restarts": summary["solver"]["restarts"], "wall_s": round(sum(summary["wall_s"].values()), 1)}


def spread(values, digits):
    reached = [v for v in values if v is not None]
    if not reached:
        return "never"
    text = f"{statistics.mean(reached):.{digits}f}"
    if len(reached) > 1:
        text += f" ± {statistics.stdev(reached):.{digits}f}"
    return text if len(reached) == len(values) else f"{text} ({len(reached)} of {len(values)})"


def print_table(rows):
    print("| row | seeds | t_50 | t_25 | t_10 | t_05 | A(end)/A_max | healed shape | yields | wall s, busy machine |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in sorted({r["row"] for r in rows}):
        these = [r for r in rows if r["row"] == name]
        cells = [spread([r[key] for r in these], 0) for key in TIMES]
        cells += [spread([r["end_fraction"] for r in these], 2), spread([r["healed_shape"] for r in these], 2),
                  spread([r["yields"] for r in these], 0), spread([r["wall_s"] for r in these], 0)]
        print(f"| {name} | {len(these)} | " + " | ".join(cells) + " |")


def main():
    rows = list(runs(sys.argv[1]))
    if not rows:
        sys.exit(f"collect.py: no finished runs in {sys.argv[1]}")
    if "--table" in sys.argv[2:]:
        print_table(rows)
    else:
        writer = csv.DictWriter(sys.stdout, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


main()
