# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and pages of results. Shared parts: `style` (colours, matplotlib), `draw` (particles, outlines), `result` (a
result file), `table` (CSV). Programs, each called as a file: figures.py, walls.py, element_figures.py, accuracy.py,
posterior.py, study_columns.py, study_causes.py, study_channel.py; the other study_*.py are their parts."""
