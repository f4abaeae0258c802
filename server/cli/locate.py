"""`mirrorlimb locate`: where radio tags were, from their ranges to the anchors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from fusion.errors import InputError
from fusion.inertial.orientation import Inertial, carried, together
from fusion.messages import Floats
from fusion.ranging.calibration import Calibration, calibrate, uncalibrated
from fusion.ranging.locate import Track, require_solvable
from fusion.ranging.locate import locate as locate_tags
from fusion.ranging.pushes import Pushes, integrated
from fusion.ranging.ranges import Ranges, gathered, interpolated
from fusion.ranging.self_calibration import self_calibrate
from fusion.recording.reader import ImuStream, RangeStream, Recording, read_recording

WAIST: Final = ("waist", "pelvis")
"""Sites of an inertial sensor that goes where a tag on the belt goes."""


@dataclass(frozen=True, slots=True)
class Truth:
    """Where the tags really were."""

    t_s: Floats  # (T,)
    positions: Floats  # (T, K, 3) m, in the order of the tags


@dataclass(frozen=True, slots=True)
class Seconds:
    """Which part of the recording is learnt from."""

    from_s: float
    with_truth_s: float
    alone_s: float

    @property
    def to_s(self) -> float:
        """The end; the beginning where nothing is to be learnt."""
        return self.from_s + max(self.with_truth_s, self.alone_s)


def locate(
    recording: Annotated[Path, typer.Argument(help="A recording: its folder or a .mcap file.", show_default=False)],
    out: Annotated[Path, typer.Option(metavar="FOLDER", help="Where position.csv goes.")],
    anchors: Annotated[
        str | None, typer.Option(metavar="A0,A2,A5", help="The anchors that may be used; all by default.")
    ] = None,
    tags: Annotated[str | None, typer.Option(metavar="T0,T1", help="The tags to locate; all by default.")] = None,
    calibrate_s: Annotated[
        float, typer.Option("--calibrate", metavar="SECONDS", min=0, help="Learn the links from so much truth.")
    ] = 0.0,
    calibrate_from_s: Annotated[
        float, typer.Option("--calibrate-from", metavar="SECONDS", min=0, help="Where that truth begins.")
    ] = 0.0,
    height: Annotated[
        float | None, typer.Option(metavar="M", help="The tags' height, where the anchors lie in one plane.")
    ] = None,
    self_calibrate_s: Annotated[
        float, typer.Option("--self-calibrate", metavar="SECONDS", min=0, help="Learn the biases without truth.")
    ] = 0.0,
) -> None:
    """Locate radio tags from ranges to three or more anchors, causally, each position with a bound."""
    source = read_recording(recording)
    stream = _range_stream(source)
    names, ranges = _chosen_ranges(stream, anchors, tags)
    require_solvable(ranges.anchors, height)
    seconds = Seconds(ranges.t_s[0] + calibrate_from_s, calibrate_s, self_calibrate_s)
    truth = _truth(source, names)
    learnt = _calibration(ranges, truth, seconds, height)
    with Progress(console=Console(stderr=True), transient=True) as progress:
        bar = progress.add_task(source.name, total=1.0)
        beside = _inertial(source, names)
        track = locate_tags(ranges, learnt, height, lambda share: progress.update(bar, completed=share), beside)
    if not np.isfinite(track.bound_m).any():
        fits = "anchors' positions and a height that the ranges fit"
        raise InputError(
            "nowhere do the ranges agree on a place", fits, "mend --height or the anchors in recording.json"
        )
    _write(out, names, track)
    _say(source.name, names, track, truth, learnt, seconds)
    _say_pushed(names, beside)
    typer.echo(f"{out / 'position.csv'}: {int(np.isfinite(track.bound_m).sum())} positions")


def _range_stream(source: Recording) -> RangeStream:
    if not source.range_streams or not len(source.range_streams[0].t_s):
        raise InputError(f"{source.path} has no ranges", "a recording with a range stream", "name another recording")
    return source.range_streams[0]


def _chosen_ranges(stream: RangeStream, anchors: str | None, tags: str | None) -> tuple[tuple[str, ...], Ranges]:
    """The chosen tags' names, and their ranges to the chosen anchors."""
    whole = gathered(stream.anchor_positions, len(stream.tags), stream.t_s, stream.anchor, stream.tag, stream.range_m)
    wanted = _chosen("tag", tuple(stream.tags), tags)
    ranges = whole.to_anchors(_chosen("anchor", tuple(stream.anchors), anchors)).of_tags(wanted)
    return tuple(stream.tags[k] for k in wanted), ranges


def _chosen(kind: str, known: tuple[str, ...], names: str | None) -> list[int]:
    wanted = known if names is None else tuple(name.strip() for name in names.split(","))
    for name in wanted:
        if name not in known:
            raise InputError(f"no {kind} is called '{name}'", f"some of {','.join(known)}", f"mend --{kind}s")
    return [known.index(name) for name in dict.fromkeys(wanted)]


def _calibration(ranges: Ranges, truth: Truth, seconds: Seconds, height: float | None) -> Calibration:
    """What some seconds teach: with truth, without, or nothing."""
    if seconds.with_truth_s and seconds.alone_s:
        raise InputError("--calibrate and --self-calibrate exclude each other", "one of them", "leave one out")
    has_s = ranges.t_s[-1] - ranges.t_s[0]
    if seconds.to_s > ranges.t_s[-1]:
        what = f"the recording ends before the seconds to learn from do; it has {has_s:.0f} s"
        raise InputError(what, "seconds that it holds, and some more to judge by", "learn from fewer")
    if seconds.alone_s and height is None:
        raise InputError("--self-calibrate works in the plane", "the tag's height", "give --height")
    if seconds.alone_s:
        return self_calibrate(ranges.between(seconds.from_s, seconds.to_s), height or 0.0)
    return _with_truth(ranges, truth, seconds) if seconds.with_truth_s else uncalibrated(ranges)


def _with_truth(ranges: Ranges, truth: Truth, seconds: Seconds) -> Calibration:
    inside = (truth.t_s >= seconds.from_s) & (truth.t_s <= seconds.to_s)
    if not np.isfinite(truth.positions[inside]).all(axis=2).any(axis=0).all():
        what = f"no truth from {seconds.from_s:g} to {seconds.to_s:g} s"
        raise InputError(what, "some of every tag", "leave --calibrate out, or name the --tags that have truth")
    return calibrate(ranges.between(seconds.from_s, seconds.to_s), truth.t_s[inside], truth.positions[inside])


def _truth(source: Recording, tags: tuple[str, ...]) -> Truth:
    """The tags' truth, NaN where there is none."""
    if source.truth is None:
        return Truth(np.empty(0), np.empty((0, len(tags), 3)))
    positions = np.full((len(source.truth.t_s), len(tags), 3), np.nan)
    for k, tag in enumerate(tags):
        if tag in source.truth.joints:
            positions[:, k] = source.truth.positions[:, source.truth.joints.index(tag)]
    return Truth(source.truth.t_s, positions)


def _inertial(source: Recording, tags: tuple[str, ...]) -> list[Pushes | None]:
    """Per tag what the sensor beside it measured: one named like the tag; or at the waist, beside an only tag."""
    streams = {stream.site: stream for stream in source.imu_streams}
    if len(tags) == 1:
        worn = next((streams[site] for site in WAIST if site in streams), None)
        return [_pushes(streams.get(tags[0], worn))]
    return [_pushes(streams.get(tag)) for tag in tags]


def _pushes(stream: ImuStream | None) -> Pushes | None:
    """Its acceleration in a level frame; the filter finds which way that points."""
    if stream is None:
        return None
    (imu,) = together([Inertial(stream.site, stream.t_s, stream.gyro_rad_s, stream.accel_m_s2)])
    return integrated(imu.t_s, carried(imu))


def _say_pushed(tags: tuple[str, ...], beside: list[Pushes | None]) -> None:
    pushed = ", ".join(tag for tag, pushes in zip(tags, beside, strict=True) if pushes is not None)
    if pushed:
        Console(stderr=True, highlight=False).print(f"With the inertial sensor beside {pushed}.")


def _write(folder: Path, tags: tuple[str, ...], track: Track) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "position.csv").write_text("".join(_lines(tags, track)), encoding="utf-8")
    except OSError as error:
        raise InputError(
            f"{folder} cannot be written: {error.strerror}", "a folder of yours", "choose another --out"
        ) from error


def _lines(tags: tuple[str, ...], track: Track) -> Iterator[str]:
    """A line per instant and tag, from the first fix on."""
    yield "t_s,tag,x_m,y_m,z_m,bound_m,anchors_used\n"
    values = (track.t_s.tolist(), track.positions.tolist(), track.bound_m.tolist(), track.anchors_used.tolist())
    for t_s, positions, bounds, used in zip(*values, strict=True):
        for tag, (x, y, z), bound, count in zip(tags, positions, bounds, used, strict=True):
            if bound == bound:  # NaN: not located yet
                yield f"{t_s:.4f},{tag},{x:.4f},{y:.4f},{z:.4f},{bound:.4f},{count}\n"


def _say(name: str, tags: tuple[str, ...], track: Track, truth: Truth, learnt: Calibration, seconds: Seconds) -> None:
    """What was learnt, and how far off each tag was where there is truth."""
    console = Console(stderr=True, highlight=False)
    sigma_mm, lag_ms = learnt.links.sigma_m * 1e3, learnt.lag_s * 1e3
    together = "together, on one stiff thing" if learnt.rig else "each on its own"
    console.print(f"Range deviation {sigma_mm:.0f} mm, lag {lag_ms:.0f} ms, tags {together}.")
    if not len(truth.t_s):
        return
    off = track.positions - interpolated(truth.t_s, truth.positions, track.t_s)
    console.print(_table(f"{name}: whole recording", tags, off, track.bound_m))
    other = (track.t_s < seconds.from_s) | (track.t_s > seconds.to_s)
    if seconds.to_s > seconds.from_s and other.any():
        console.print(_table(f"{name}: outside the seconds learnt from", tags, off[other], track.bound_m[other]))


def _table(title: str, tags: tuple[str, ...], off: Floats, bound_m: Floats) -> Table:
    table = Table(title=title, caption="mm; inside: share of instants within the bound", box=SIMPLE_HEAD)
    for name in ("tag", "rms 2-D", "rms 3-D", "p95", "max", "bound p50", "inside"):
        table.add_column(name, justify="left" if name == "tag" else "right")
    for k, tag in enumerate(tags):
        known = np.isfinite(off[:, k]).all(axis=1)
        if known.any():
            table.add_row(tag, *_figures(off[known, k], bound_m[known, k]))
    return table


def _figures(off: Floats, bound_m: Floats) -> list[str]:
    flat, whole = np.linalg.norm(off[:, :2], axis=1), np.linalg.norm(off, axis=1)
    rms = [np.sqrt(np.mean(distance**2)) for distance in (flat, whole)]
    lengths = [*rms, np.percentile(flat, 95), flat.max(), np.median(bound_m)]
    return [*(f"{length * 1e3:.0f}" for length in lengths), f"{100 * np.mean(whole <= bound_m):.1f} %"]
