"""Each requirement of docs/safety.md is shown by tests that exist and carry its number; no test carries another."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
TABLE = ROOT / "docs" / "safety.md"
MOTION = tuple(f"SR-{number}" for number in (*range(1, 13), 18))
"""What concerns motion; each has at least one test. The others are in docs/security.md."""


def _rows() -> dict[str, list[str]]:
    """Requirement to the cells after it."""
    found = re.findall(r"^\| (SR-\d+) \|(.+)\|$", TABLE.read_text("utf-8"), flags=re.MULTILINE)
    return {name: [cell.strip() for cell in cells.split("|")] for name, cells in found}


def _tests_of(row: list[str]) -> list[str]:
    return [name for cell in row for name in re.findall(r"`(test_\w+)`", cell)]


def _numbers(test: str) -> set[str]:
    return {f"SR-{number}" for number in re.findall(r"(?<=_)sr(\d+)(?=_)", test)}


@pytest.fixture(scope="module")
def all_tests() -> set[str]:
    trees = (ast.parse(path.read_text("utf-8")) for path in (ROOT / "tests").rglob("test_*.py"))
    functions = (node for tree in trees for node in ast.walk(tree))
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    return {node.name for node in functions if isinstance(node, kinds) and node.name.startswith("test_")}


def test_sr12_every_requirement_of_motion_has_its_row_its_tests_and_its_figure() -> None:
    rows = _rows()
    assert set(MOTION) <= set(rows)
    for name in MOTION:
        assert _tests_of(rows[name]), name
        assert len(rows[name][-1]) > 3, f"{name} has no figure"


def test_sr12_every_test_that_is_named_exists_and_carries_the_number(all_tests: set[str]) -> None:
    for name, row in _rows().items():
        for test in _tests_of(row):
            assert test in all_tests, f"{name} names {test}, which does not exist"
            assert name in _numbers(test), f"{test} does not carry {name}"


def test_sr12_no_test_carries_a_number_that_no_requirement_has(all_tests: set[str]) -> None:
    known = {f"SR-{number}" for number in range(1, 19)}
    assert not {number for test in all_tests for number in _numbers(test)} - known
