# SPDX-License-Identifier: BSD-3-Clause
"""What all pictures share: matplotlib without a screen, colours, the unit of length."""
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy  # noqa: F401
except ImportError as error:
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: needs numpy and matplotlib ({error}): "
             "apt-get install python3-matplotlib")

MM = 1000.0  # mm in a metre
# Colours that stay apart for colour-blind readers (Okabe and Ito).
COLOURS = BLUE, ORANGE, GREEN, PURPLE, SKY, AMBER, GREY, BLACK = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#555555", "#000000")


def use(font_size, dpi, **more):
    """Settings of all pictures of a program."""
    plt.rcParams.update({"font.size": font_size, "savefig.dpi": dpi, "legend.frameon": False, **more})
