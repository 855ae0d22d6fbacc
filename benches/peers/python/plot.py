"""Work-precision plot: plot.py DATA.json OUT (writes OUT.png)."""

import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter

# A colour for each language, a mark and a dash for each method of it.
COLOURS = {"brinell": "#c8102e", "run": "#c8102e", "arkode": "#1f4e79", "cvode": "#4a90c2", "diffsol": "#6f4e9c"}
COLOURS |= {"numba": "#2e7d32", "numpy": "#c77700", "octave": "#666666"}
MARKS = ["o", "s", "^", "D", "v"]


def main():
    data = json.load(open(sys.argv[1]))
    plt.rcParams |= {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False}
    figure, axes = plt.subplots(figsize=(9.0, 6.0), layout="constrained")
    seen = {}
    for curve in data["curves"]:
        if not curve["points"]:
            continue
        family = curve["key"].split("-")[0]
        colour = COLOURS.get(family, "black")
        mark = MARKS[seen.setdefault(colour, 0) % len(MARKS)]
        seen[colour] += 1
        errors, costs = zip(*curve["points"])
        ours = family == "brinell"
        style = dict(color=colour, marker=mark, markersize=6 if ours else 4, linewidth=2.5 if ours else 1.2, label=curve["name"])
        if curve["key"] == "run":
            style |= {"marker": "*", "markersize": 12, "linestyle": "none"}
        axes.loglog([100 * e for e in errors], costs, **style)
    axes.axvline(100 * data["matched"], color="black", linewidth=0.8, linestyle=(0, (4, 3)))
    axes.axvspan(axes.get_xlim()[0], 100 * data["floor"], color="#eeeeee", zorder=0, linewidth=0)
    axes.set_xlim(left=max(axes.get_xlim()[0], 20 * data["floor"]))
    axes.set_xlabel("median error of outer_ax over windows of 2.5 ms, %  (grey: the reference's own doubt)")
    axes.set_ylabel("CPU s per simulated s")
    axes.set_title("NN3007 with a 3 mm x 4 mm spall: cost against error", loc="left")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.grid(which="major", color="#dddddd", linewidth=0.6)
    figure.legend(loc="outside right upper", frameon=False, fontsize=8)
    figure.savefig(f"{sys.argv[2]}.png", dpi=160, metadata={"Software": None})


if __name__ == "__main__":
    main()
