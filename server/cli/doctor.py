"""`mirrorlimb doctor`: what this machine has, what is missing, and the command that mends it."""

from __future__ import annotations

import os
import platform
import socket
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import psutil
import typer
from rich.console import Console
from rich.markup import escape

from server import __version__
from server.cli.browser import VARIABLE, find_browser
from server.config import Config, default_data_folder, read_config
from server.station import pacemaker
from server.station.exo import drives

STATIC = Path(__file__).parents[1] / "api" / "static" / "index.html"
ENOUGH_DISK_BYTES = 2 * 1024**3


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing looked at: whether it is as it should be, and the mend where it is not."""

    what: str
    good: bool
    found: str
    mend: str = ""
    needed: bool = True
    """False where the project works without it."""


def doctor(
    config: Annotated[Path | None, typer.Option(help="Configuration file (TOML) to check against.")] = None,
) -> None:
    """Say what this machine has, what is missing, and the command that mends it."""
    findings = tuple(examine(read_config(config) if config else Config()))
    console = Console(soft_wrap=True, highlight=False)
    for line in (*_lines(findings), _summary(findings)):
        console.print(line)
    if any(finding.needed and not finding.good for finding in findings):
        raise typer.Exit(2)


def examine(config: Config) -> Iterator[Finding]:
    """Look at everything, in the order in which a person would mend it."""
    yield _python()
    yield _cores()
    yield _web_pages()
    yield from _data_folders(config)
    yield _tcp_port(config.host, config.port)
    for dialect, port in config.station.sensors.ports.items():
        yield _udp_port(dialect, config.station.sensors.bind, port)
    yield _drive(config)
    yield _loopback_senders()
    yield _real_time()
    yield _browser()
    yield _recordings()


def _python() -> Finding:
    good = sys.version_info >= (3, 11)
    return Finding(
        "Python", good, f"{platform.python_version()}, mirrorlimb {__version__}", "install Python 3.11 or newer"
    )


def _cores() -> Finding:
    cores = os.cpu_count() or 1
    gib = psutil.virtual_memory().total / 1024**3
    found = f"{cores} cores, {gib:.0f} GiB of memory"
    return Finding("Processor", cores >= 2, found, "2 cores are the least that holds 100 Hz beside a browser", False)


def _web_pages() -> Finding:
    built = STATIC.is_file()
    return Finding("Web pages", built, "built" if built else "not built", "make setup")


def _data_folders(config: Config) -> Iterator[Finding]:
    folder = Path(config.data) if config.data else default_data_folder(config.demo)
    place = next(parent for parent in (folder, *folder.parents) if parent.exists())
    writable = place.is_dir() and os.access(place, os.W_OK)
    yield Finding("Data folder", writable, f"{folder}", f"--data FOLDER with a folder you may write to; {place} is not")
    free = psutil.disk_usage(str(place)).free
    yield Finding("Disk", free > ENOUGH_DISK_BYTES, f"{free / 1024**3:.0f} GiB free", "free 2 GiB", False)


def _tcp_port(host: str, port: int) -> Finding:
    free = _can_bind(socket.SOCK_STREAM, host, port)
    return Finding("Web address", free, f"{host}:{port} {_free(free)}", f"--port {port + 1}, or end what uses it")


def _udp_port(dialect: str, host: str, port: int) -> Finding:
    free = _can_bind(socket.SOCK_DGRAM, host, port)
    mend = f"another port for '{dialect}' under [station.sensors.ports] in a --config file, or end what uses it"
    return Finding(f"Sensors' port ({dialect})", free, f"UDP {host}:{port} {_free(free)}", mend)


def _drive(config: Config) -> Finding:
    exoskeleton = config.station.exoskeleton
    family, absent = exoskeleton.drive, drives.missing(exoskeleton.drive)
    found = f"'{exoskeleton.name}', drive '{family}'"
    if not absent:
        return Finding("Exoskeleton", True, found)
    return Finding("Exoskeleton", False, f"{found}; {' and '.join(absent)} not installed", drives.install(family))


def _free(free: bool) -> str:
    return "is free" if free else "is in use or not allowed"


def _can_bind(kind: socket.SocketKind, host: str, port: int) -> bool:
    with socket.socket(socket.AF_INET, kind) as probe:
        if kind is socket.SOCK_STREAM:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError:
            return False
    return True


def _loopback_senders() -> Finding:
    good = _can_bind(socket.SOCK_DGRAM, "127.0.0.2", 0)
    mend = "sudo ifconfig lo0 alias 127.0.0.2 (needed by `replay` and the demonstration)"
    return Finding("Loopback senders", good, "127.0.0.2 can send" if good else "only 127.0.0.1 can send", mend)


def _real_time() -> Finding:
    # Tried, not guessed: in a container even root may not.
    allowed = pacemaker.ask_for_priority()
    pacemaker.give_up_priority()
    found = "real-time priority is allowed" if allowed else "no real-time priority: more jitter under load"
    return Finding("Priority", allowed, found, f"add '{_user()} - rtprio 50' to /etc/security/limits.conf", False)


def _user() -> str:
    return psutil.Process().username()


def _browser() -> Finding:
    path = find_browser()
    mend = f"sudo apt-get install chromium, or set {VARIABLE} (needed by `make test` only)"
    return Finding("Browser for the tests", path is not None, path or "none found", mend, needed=False)


def _recordings() -> Finding:
    named = os.environ.get("MIRRORLIMB_RECORDINGS", "")
    good = bool(named) and Path(named).is_dir()
    mend = "set MIRRORLIMB_RECORDINGS to their folder (tests on real recordings are left out without it)"
    return Finding("Real recordings", good, named or "not named", mend, needed=False)


def _lines(findings: tuple[Finding, ...]) -> Iterator[str]:
    """One line a finding, the mend beneath it: readable in a narrow terminal and through a pipe."""
    for finding in findings:
        yield f"{_mark(finding)}  [bold]{finding.what}[/]: {escape(finding.found)}"
        if not finding.good:
            yield f"     what to do: {escape(finding.mend)}"


def _mark(finding: Finding) -> str:
    if finding.good:
        return "[green]✓[/]"
    return "[red]✗[/]" if finding.needed else "[yellow]![/]"


def _summary(findings: tuple[Finding, ...]) -> str:
    missing = sum(finding.needed and not finding.good for finding in findings)
    if missing:
        return f"{missing} of these must be mended before mirrorlimb can run."
    return "Nothing that is needed is missing."
