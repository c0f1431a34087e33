"""What the plotting scripts of the figures share: tables in, one PNG out. Needs python3-matplotlib and python3-numpy."""
import csv
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
                     "savefig.dpi": 150})


def arguments():
    """Folder of our results, folder of the published numbers, picture to be written."""
    if len(sys.argv) != 4:
        sys.exit(f"usage: {sys.argv[0]} RESULTS PUBLISHED PICTURE.png")
    return [pathlib.Path(argument) for argument in sys.argv[1:]]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def read(path):
    """Rows as dictionaries; what looks like a number is one, an empty field is an empty text."""
    with open(path, newline="") as stream:
        return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(stream)]


def select(rows, **wanted):
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def column(rows, name):
    return [row[name] for row in rows]


def save(figure, picture, tight=True):
    if tight:
        figure.tight_layout()
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, bbox_inches="tight")
    print(f"wrote {picture}")
