#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Brings the notebooks in docs/tutorial/notebooks to the form in which they are committed: without outputs, execution counts and what an
editor adds, so that a diff shows only what a person changed. Run it after you edit a notebook in Jupyter.

  scripts/docs/clean_notebooks.py

The notebooks have no other source. python/tests/test_notebooks.py checks their form and runs their cells.
"""

import json
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "tutorial" / "notebooks"
METADATA = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}, "language_info": {"name": "python"}}


def cleaned_cell(cell):
    tags = cell["metadata"].get("tags")
    source = "".join(cell["source"]).strip("\n")
    out = {"cell_type": cell["cell_type"], "id": cell["id"], "metadata": {"tags": tags} if tags else {}, "source": source.splitlines(keepends=True)}
    return {**out, "execution_count": None, "outputs": []} if cell["cell_type"] == "code" else out


def cleaned(text):
    """Returns the text of a notebook in the committed form, with the same cells."""
    cells = [cleaned_cell(cell) for cell in json.loads(text)["cells"]]
    notebook = {"cells": cells, "metadata": METADATA, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(notebook, ensure_ascii=False, indent=1, sort_keys=True) + "\n"


def paths():
    return sorted(FOLDER.glob("*.ipynb"))


if __name__ == "__main__":
    for path in paths():
        before = path.read_text(encoding="utf-8")
        after = cleaned(before)
        if after != before:
            path.write_text(after, encoding="utf-8")
            print(f"clean_notebooks.py: {path.name}")
