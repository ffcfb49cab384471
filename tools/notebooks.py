#!/usr/bin/python3
"""notebooks.py [--accept] [NAME]...   runs the notebooks of examples/notebooks and compares their output with
the stored one; --accept overwrites the stored output.

Only text is compared. HTML output is large and tested elsewhere. The notebooks import the package of the build
folder SINEW_BUILD, by default build/release.
"""

import difflib
import os
import pathlib
import sys
import tempfile
from typing import Any, List

import nbclient
import nbformat

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "examples" / "notebooks"


def output_lines(cell: Any) -> List[str]:
    """Return the lines that a cell prints, and the text form of its results."""
    text = ""
    for output in cell.get("outputs", []):
        if output.output_type == "stream":
            text += output.text  # the kernel may split it anywhere
        else:
            text += output.get("data", {}).get("text/plain", "") + "\n"
    return text.splitlines()


def without_pages(notebook: Any) -> Any:
    """Remove all output but text, so that committed notebooks are small."""
    for cell in notebook.cells:
        cell.pop("execution_count", None)
        if cell.cell_type != "code":
            continue
        cell.execution_count = None
        cell.metadata.clear()
        outputs: List[Any] = []
        for output in cell.outputs:
            if outputs and output.output_type == outputs[-1].output_type == "stream":
                outputs[-1].text += output.text
            else:
                outputs.append(output)
        cell.outputs = outputs
        for output in cell.outputs:
            output.pop("execution_count", None)
            if output.output_type != "stream":
                output.data = {k: v for k, v in output.data.items() if k == "text/plain"}
                if output.output_type == "execute_result":
                    output.execution_count = None
    return notebook


def check(path: pathlib.Path, accept: bool) -> bool:
    """Run a notebook; return whether its output equals the stored one."""
    stored = nbformat.read(path, as_version=4)
    ran = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(
            ran, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}}
        ).execute()
    if accept:
        nbformat.write(without_pages(ran), path)
        print(f"{path.name}: accepted")
        return True
    for number, (old, new) in enumerate(zip(stored.cells, ran.cells)):
        if output_lines(old) == output_lines(new):
            continue
        print(f"{path.name}: the output of cell {number} differs:")
        print("\n".join(difflib.unified_diff(output_lines(old), output_lines(new), "stored", "now", lineterm="")))
        print(f"if it is right: tools/notebooks.py --accept {path.stem}")
        return False
    print(f"{path.name}: as stored")
    return True


def main() -> int:
    """Run the named notebooks, or all."""
    words = sys.argv[1:]
    accept = "--accept" in words
    names = [word for word in words if word != "--accept"]
    package = ROOT / os.environ.get("SINEW_BUILD", "build/release") / "python"
    if not (package / "sinew" / "_where.py").exists():
        print(f"notebooks.py: {package} has no package; cmake --preset release && "
              "cmake --build --preset release", file=sys.stderr)
        return 1
    os.environ["PYTHONPATH"] = str(package)
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    paths = [FOLDER / f"{name}.ipynb" for name in names] or sorted(FOLDER.glob("*.ipynb"))
    for path in paths:
        if not path.exists():
            print(f"notebooks.py: {path}: does not exist", file=sys.stderr)
            return 2
    return 0 if all([check(path, accept) for path in paths]) else 1


if __name__ == "__main__":
    sys.exit(main())
