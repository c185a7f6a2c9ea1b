# SPDX-License-Identifier: Apache-2.0
"""Runs the notebooks in docs/tutorial/notebooks without Jupyter, with and without the solutions in docs/teachers/notebooks.md, and checks
the form of their files."""

import ast
import json
import re
import sys

import pytest

from conftest import ROOT

sys.path.insert(0, str(ROOT / "scripts" / "docs"))
import clean_notebooks  # noqa: E402

PATHS = clean_notebooks.paths()
each = pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)


def source(cell):
    return "".join(cell["source"])


def cells_of(path, kind="code", tag=None):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in cells if cell["cell_type"] == kind and (tag is None or tag in cell["metadata"].get("tags", []))]


def only(cells):
    assert len(cells) == 1
    return cells[0]


def run_cell(code, name, names):
    """Runs a cell and returns the value of its last expression, which Jupyter would display."""
    body = ast.parse(code).body
    last = ast.Expression(body.pop().value) if isinstance(body[-1], ast.Expr) else None
    exec(compile(ast.Module(body, []), name, "exec"), names)
    return eval(compile(last, name, "eval"), names) if last else None


def answers(number):
    """Returns the solution and the typical mistake of a notebook."""
    text = (ROOT / "docs" / "teachers" / "notebooks.md").read_text(encoding="utf-8")
    section = text.split(f"\n## Notebook {number}\n")[1].split("\n## ")[0]
    solution, mistake = re.findall(r"^```python\n(.*?)^```", section, flags=re.S | re.M)
    return solution, mistake


def test_there_are_five():
    assert [path.name[:3] for path in PATHS] == ["01_", "02_", "03_", "04_", "05_"]
    readme = (clean_notebooks.FOLDER / "README.md").read_text(encoding="utf-8")
    assert [path.name for path in PATHS if f"]({path.name})" not in readme] == []


@each
def test_cells_run_in_order(path, capsys):
    names, pictures = {}, 0
    for cell in cells_of(path):
        shown = run_cell(source(cell), f"{path.name}, cell {cell['id']}", names)
        if hasattr(shown, "_repr_png_"):
            assert shown._repr_png_().startswith(b"\x89PNG\r\n\x1a\n")
            pictures += 1
    assert pictures >= 1
    assert capsys.readouterr().out.endswith("The exercise is not solved yet.\n")

    check = source(only(cells_of(path, tag="check")))
    solution, mistake = answers(int(path.name[:2]))
    run_cell(mistake, "mistake", names)
    with pytest.raises(AssertionError):
        run_cell(check, "check", names)
    run_cell(solution, "solution", names)
    run_cell(check, "check", names)
    assert capsys.readouterr().out.startswith("Correct: ")


@each
def test_a_student_sees_a_placeholder_and_no_solution(path):
    exercise = source(only(cells_of(path, tag="exercise")))
    assert len(re.findall(r"(?:return|=) \.\.\.  # replace the three dots", exercise)) == 1
    assert len(exercise.strip().split("\n")) <= 2
    # A line of the solution could also be in another cell.
    text = path.read_text(encoding="utf-8")
    for line in answers(int(path.name[:2]))[0].strip().split("\n"):
        assert line.startswith("def ") or line.strip() not in text


@each
def test_text_states_what_a_student_needs(path):
    cells = [source(cell) for cell in cells_of(path, "markdown")]
    assert cells[0].startswith(f"# Notebook {int(path.name[:2])}: ")
    for text in ("- **Before this notebook**: ", "- **Goal**: ", "- **Time**: "):
        assert text in cells[0]
    assert any(text.startswith("## Exercise\n") for text in cells)
    links = re.findall(r"\]\(([^)\s]+)\)", "\n".join(cells))
    assert len(links) >= 3 and [link for link in links if not (path.parent / link).exists()] == []


@each
def test_file_has_the_structure_of_nbformat_4(path):
    """nbformat.validate() checks the same; it is not needed here."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    assert sorted(notebook) == ["cells", "metadata", "nbformat", "nbformat_minor"]
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)  # 4.5 introduced the ids of cells
    assert notebook["metadata"]["kernelspec"]["name"] == "python3"
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids) and all(re.fullmatch(r"[A-Za-z0-9_-]{1,64}", name) for name in ids)
    for cell in notebook["cells"]:
        lines = cell["source"]
        assert lines and all(line.endswith("\n") for line in lines[:-1]) and not any("\n" in line[:-1] for line in lines)
        keys = ["cell_type", "id", "metadata", "source"]
        if cell["cell_type"] == "code":
            assert (cell["execution_count"], cell["outputs"]) == (None, [])
            assert max(map(len, lines)) <= 101  # 100 characters and the end of the line fit into a window
            keys = sorted([*keys, "execution_count", "outputs"])
        else:
            assert cell["cell_type"] == "markdown"
        assert sorted(cell) == keys


@each
def test_file_is_clean(path):
    text = path.read_text(encoding="utf-8")
    assert clean_notebooks.cleaned(text) == text, "run scripts/docs/clean_notebooks.py"
    used = json.loads(text)
    used["metadata"]["language_info"]["version"] = "3.11.2"
    for cell in used["cells"]:
        cell["metadata"]["scrolled"] = True
        if cell["cell_type"] == "code":
            cell.update(execution_count=7, outputs=[{"name": "stdout", "output_type": "stream", "text": ["1\n"]}])
    assert clean_notebooks.cleaned(json.dumps(used)) == text
