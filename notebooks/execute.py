#!/usr/bin/python3
"""execute.py NOTEBOOK --figures FILE [--chart FILE.png]: runs a notebook on a file of figures without changing it, prints
what its cells print, and keeps its chart. Fails where a cell fails, or where there is no chart."""
import argparse
import base64
import os
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("notebook", type=Path)
    parser.add_argument("--figures", type=Path, required=True, help="what partition_study or accuracy_sweep wrote")
    parser.add_argument("--chart", type=Path, help="where the chart goes")
    arguments = parser.parse_args()
    os.environ["ENFILADE_FIGURES"] = str(arguments.figures.resolve())
    notebook = nbformat.read(arguments.notebook, as_version=4)
    try:
        NotebookClient(notebook, timeout=120, kernel_name="python3",
                       resources={"metadata": {"path": str(arguments.notebook.resolve().parent)}}).execute()
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
