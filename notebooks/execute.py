#!/usr/bin/python3
"""execute.py NOTEBOOK --csv FILE [--chart FILE.png]: runs a notebook on a CSV of figures without changing it, prints
what its cells print, and keeps its chart. Fails where a cell fails, or where there is no chart."""
import argparse
import base64
import os
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError


def execute(path: Path):
    """Returns the notebook with its outputs. Jupyter chooses the kernel's TCP ports before the kernel opens them, so that another program
    may take one in between; then the kernel dies at once, and is started anew."""
    starts = 3
    for start in range(starts):
        notebook = nbformat.read(path, as_version=4)
        try:
            NotebookClient(notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(path.resolve().parent)}}).execute()
            return notebook
        except RuntimeError:  # a cell that fails raises another
            if start + 1 == starts:
                raise


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("notebook", type=Path)
    parser.add_argument("--csv", type=Path, required=True, help="the figures, which the notebook finds as $ENFILADE_CSV")
    parser.add_argument("--chart", type=Path, help="where the chart goes")
    arguments = parser.parse_args()
    os.environ["ENFILADE_CSV"] = str(arguments.csv.resolve())
    try:
        notebook = execute(arguments.notebook)
    except CellExecutionError as error:
        print(error, file=sys.stderr)
        return 1
    charts = []
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            print(output.get("text", ""), end="")
            charts += [output["data"]["image/png"]] if "image/png" in output.get("data", {}) else []
    if len(charts) != 1:
        print(f"{arguments.notebook}: {len(charts)} charts, not one", file=sys.stderr)
        return 1
    if arguments.chart:
        arguments.chart.write_bytes(base64.b64decode(charts[0]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
