"""`mirrorlimb locate`: where radio tags were, from their ranges to the anchors."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from fusion.errors import InputError
from fusion.messages import Floats
from fusion.ranging.calibration import Calibration, calibrate, interpolated, uncalibrated
from fusion.ranging.locate import Track, require_solvable
from fusion.ranging.locate import locate as locate_tags
from fusion.ranging.ranges import Ranges, gathered
from fusion.ranging.self_calibration import self_calibrate
from fusion.recording.reader import RangeStream, Recording, read_recording


def locate(
    recording: Annotated[Path, typer.Argument(help="A recording: its folder or a .mcap file.", show_default=False)],
    out: Annotated[Path, typer.Option(metavar="FOLDER", help="Where position.csv goes.")],
    anchors: Annotated[
        str | None, typer.Option(metavar="A0,A2,A5", help="The anchors that may be used; all by default.")
    ] = None,
    calibrate_s: Annotated[
        float, typer.Option("--calibrate", metavar="SECONDS", min=0, help="Learn the links from so much truth.")
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
    ranges = gathered(
        stream.anchor_positions, len(stream.tags), stream.t_s, stream.anchor, stream.tag, stream.range_m
    ).to_anchors(_chosen(stream, anchors))
    require_solvable(ranges.anchors, height)
    learnt = _calibration(source, stream, ranges, (calibrate_s, self_calibrate_s), height)
    with Progress(console=Console(stderr=True), transient=True) as progress:
        bar = progress.add_task(source.name, total=1.0)
        track = locate_tags(ranges, learnt, height, lambda share: progress.update(bar, completed=share))
    _write(out, stream.tags, track)
    _say(source, stream, track, learnt, max(calibrate_s, self_calibrate_s))
    typer.echo(f"{out / 'position.csv'}: {int(np.isfinite(track.bound_m).sum())} positions")


def _range_stream(source: Recording) -> RangeStream:
    if not source.range_streams or not len(source.range_streams[0].t_s):
        raise InputError(f"{source.path} has no ranges", "a recording with a range stream", "name another recording")
    return source.range_streams[0]


def _chosen(stream: RangeStream, names: str | None) -> list[int]:
    wanted = list(stream.anchors) if names is None else [name.strip() for name in names.split(",")]
    for name in wanted:
        if name not in stream.anchors:
            raise InputError(f"no anchor is called '{name}'", f"some of {','.join(stream.anchors)}", "mend --anchors")
    return [stream.anchors.index(name) for name in dict.fromkeys(wanted)]


def _calibration(
    source: Recording, stream: RangeStream, ranges: Ranges, seconds: tuple[float, float], height: float | None
) -> Calibration:
    """What the first seconds teach: with truth, without, or nothing."""
    with_truth_s, alone_s = seconds
    if with_truth_s and alone_s:
        raise InputError("--calibrate and --self-calibrate exclude each other", "one of them", "leave one out")
    if with_truth_s:
        end_s = ranges.t_s[0] + with_truth_s
        truth_t_s, truth = _truth(source, stream)
        early = truth_t_s <= end_s
        if not np.isfinite(truth[early]).all(axis=2).any(axis=0).all():
            raise InputError(f"no truth in the first {with_truth_s:g} s", "some of every tag", "leave --calibrate out")
        return calibrate(ranges.until(end_s), truth_t_s[early], truth[early])
    if alone_s:
        if height is None:
            raise InputError("--self-calibrate works in the plane", "the tag's height", "give --height")
        return self_calibrate(ranges.until(ranges.t_s[0] + alone_s), height)
    return uncalibrated(ranges)


def _truth(source: Recording, stream: RangeStream) -> tuple[Floats, Floats]:
    """Times (T,) and positions (T, K, 3) in the order of the tags; NaN where there is no truth."""
    if source.truth is None:
        return np.empty(0), np.empty((0, len(stream.tags), 3))
    positions = np.full((len(source.truth.t_s), len(stream.tags), 3), np.nan)
    for k, tag in enumerate(stream.tags):
        if tag in source.truth.joints:
            positions[:, k] = source.truth.positions[:, source.truth.joints.index(tag)]
    return source.truth.t_s, positions


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


def _say(source: Recording, stream: RangeStream, track: Track, learnt: Calibration, learnt_for_s: float) -> None:
    """What was learnt, and how far off each tag was where there is truth."""
    console = Console(stderr=True, highlight=False)
    sigma_mm, lag_ms = learnt.links.sigma_m * 1e3, learnt.lag_s * 1e3
    together = "together, on one stiff thing" if learnt.rig else "each on its own"
    console.print(f"Range deviation {sigma_mm:.0f} mm, lag {lag_ms:.0f} ms, tags {together}.")
    truth_t_s, truth = _truth(source, stream)
    if not len(truth_t_s):
        return
    off = track.positions - interpolated(truth_t_s, truth, track.t_s)
    later = track.t_s > track.t_s[0] + learnt_for_s
    for title, chosen in (("whole recording", np.isfinite(track.t_s)), ("after the calibration", later)):
        if chosen.any() and (chosen is not later or learnt_for_s):
            console.print(_table(f"{source.name}: {title}", stream.tags, off[chosen], track.bound_m[chosen]))


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
