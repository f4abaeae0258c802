"""The browser side's build: only when something has changed, and in words where it cannot."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
WEB = ROOT / "web"


@pytest.fixture
def hatch_build() -> ModuleType:
    spec = importlib.util.spec_from_file_location("hatch_build", WEB / "hatch_build.py")
    if spec is None or spec.loader is None:
        pytest.fail("web/hatch_build.py cannot be loaded")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def lock() -> dict[str, dict[str, object]]:
    packages: dict[str, dict[str, object]] = json.loads((WEB / "package-lock.json").read_text())["packages"]
    return packages


def _script(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "web/hatch_build.py", *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )


def test_second_build_leaves_everything_as_it_is() -> None:
    assert _script().returncode == 0
    pages = [file for file in (ROOT / "server" / "api" / "static").rglob("*") if file.is_file()]
    before = {file: file.stat().st_mtime_ns for file in pages}
    again = _script()
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")
    assert {file: file.stat().st_mtime_ns for file in pages} == before


def test_build_makes_both_pages() -> None:
    assert _script().returncode == 0
    for page in ("index.html", "play.html"):
        assert "/assets/" in (ROOT / "server" / "api" / "static" / page).read_text()


def test_unknown_errand_names_the_known_ones() -> None:
    done = _script("deploy")
    assert done.returncode == 2
    assert "build, types, check" in done.stderr


def test_any_changed_source_changes_the_digest(
    hatch_build: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hatch_build, "WEB", tmp_path)
    source = tmp_path / "a.ts"
    source.write_text("1")
    first = hatch_build._digest([source])
    source.write_text("2")
    assert hatch_build._digest([source]) != first


def test_a_failing_step_says_what_to_do(hatch_build: ModuleType) -> None:
    with pytest.raises(hatch_build.WebBuildError, match=r"failed in .*: try this"):
        hatch_build._run([sys.executable, "-c", "raise SystemExit(3)"], ROOT, "try this")


def test_lock_file_carries_no_download_addresses(lock: dict[str, dict[str, object]]) -> None:
    assert [name for name, entry in lock.items() if "resolved" in entry] == []


def test_lock_file_knows_every_platform(lock: dict[str, dict[str, object]]) -> None:
    known = {name.rpartition("node_modules/")[2] for name in lock}
    wanted = {name for entry in lock.values() for name in dict(entry.get("optionalDependencies", {}))}  # type: ignore[call-overload]  # JSON
    assert wanted - known == set()
