"""What is drawn in the 3-D view: batches of meshes that are made once and moved in place."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
import trimesh.creation
import viser

from fusion.skeleton import BONE_INDICES
from server.api.view3d_picture import NO_ARM, NOWHERE, Picture, SensorPicture
from server.api.view3d_shapes import Array, Placement, facing, place_balls, place_bones, place_bounds

Colour = tuple[int, int, int]

SENSOR_COLOURS: tuple[Colour, ...] = ((205, 70, 150), (40, 150, 70), (130, 80, 200), (150, 110, 30))
"""Per sensor in the order of the tick; again from the first where there are more."""
FUSED: Colour = (25, 45, 105)
BOUND: Colour = (90, 140, 230)
MIRRORED: Colour = (255, 150, 0)
EXO: Colour = (0, 170, 205)
FAINT = 0.45

FUSED_M, SENSOR_M, EXO_M, MIRRORED_M = 0.016, 0.011, 0.03, 0.05
"""Radii. The arm that is to be followed is a wide, pale sleeve round the exoskeleton's while both agree."""

ARM_BONES = np.array([(0, 1), (1, 2), (2, 3)])

_CYLINDER = trimesh.creation.cylinder(radius=1.0, height=1.0, sections=8)
_BALL = trimesh.creation.icosphere(subdivisions=2, radius=1.0)


class _Batch:
    """Many copies of one mesh behind one handle: a handle per joint costs several times the time."""

    def __init__(
        self,
        scene: viser.SceneApi,
        name: str,
        mesh: trimesh.Trimesh,
        placed: Placement,
        colour: Colour,
        opacity: float | None = None,
    ) -> None:
        self.handle = scene.add_batched_meshes_simple(
            name,
            np.asarray(mesh.vertices, np.float32),
            np.asarray(mesh.faces, np.uint32),
            placed.wxyzs,
            placed.positions,
            batched_scales=placed.scales,
            batched_colors=colour,
            opacity=opacity,
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )

    def move(self, placed: Placement) -> None:
        self.handle.batched_wxyzs = placed.wxyzs
        self.handle.batched_positions = placed.positions
        self.handle.batched_scales = placed.scales


class _SensorFigure:
    """One sensor: its own skeleton, faint, and where it stands."""

    def __init__(self, scene: viser.SceneApi, number: int, name: str) -> None:
        colour = SENSOR_COLOURS[number % len(SENSOR_COLOURS)]
        root = f"/sensors/{number}"
        bones, joints = place_bones(NOWHERE, BONE_INDICES, SENSOR_M), place_balls(NOWHERE, 2 * SENSOR_M)
        self._bones = _Batch(scene, f"{root}/bones", _CYLINDER, bones, colour, FAINT)
        self._joints = _Batch(scene, f"{root}/joints", _BALL, joints, colour, FAINT)
        self._camera = scene.add_camera_frustum(
            f"{root}/camera", fov=pi / 3, aspect=1.2, scale=0.1, color=colour, visible=False
        )
        self._label = scene.add_label(f"{root}/camera/name", name)

    def show(self, seen: SensorPicture, visible: bool) -> None:
        self._bones.handle.visible = self._joints.handle.visible = visible
        self._bones.move(place_bones(seen.joints, BONE_INDICES, SENSOR_M))
        self._joints.move(place_balls(seen.joints, 2 * SENSOR_M))
        is_placed = bool(np.isfinite(seen.position).all())
        self._camera.visible = visible and is_placed
        if is_placed and np.isfinite(seen.joints).any():
            self._camera.position = seen.position
            self._camera.wxyz = facing(seen.position, np.nanmean(seen.joints, axis=0))


@dataclass(frozen=True, slots=True)
class Shown:
    """What a person has switched on."""

    sensors: bool
    bounds: bool


class Scene:
    """The whole view. Everything is in the room's frame: y up, the reference sensor at its origin."""

    def __init__(self, server: viser.ViserServer) -> None:
        scene = self._scene = server.scene
        scene.set_up_direction("+y")
        scene.configure_environment_map(hdri=None)  # weak screens
        scene.configure_default_lights(cast_shadow=False)
        scene.add_light_ambient("/light", intensity=1.5)  # the default lights leave the side that faces us dark
        self._floor = scene.add_grid("/floor", 6.0, 6.0, plane="xz", position=(0.0, -1.0, 2.0), shadow_opacity=0.0)
        self._bones = _Batch(scene, "/fused/bones", _CYLINDER, place_bones(NOWHERE, BONE_INDICES, FUSED_M), FUSED)
        self._joints = _Batch(scene, "/fused/joints", _BALL, place_balls(NOWHERE, 1.5 * FUSED_M), FUSED)
        self._bounds = _Batch(scene, "/bounds", _BALL, place_balls(NOWHERE, 0.1), BOUND, 0.18)
        sleeve = place_bones(NO_ARM, ARM_BONES, MIRRORED_M)
        self._mirrored = _Batch(scene, "/mirrored", _CYLINDER, sleeve, MIRRORED, 0.4)
        self._exo = _Batch(scene, "/exoskeleton", _CYLINDER, place_bones(NO_ARM, ARM_BONES, EXO_M), EXO)
        self._sensors: dict[str, _SensorFigure] = {}

    def show(self, picture: Picture, shown: Shown) -> None:
        """Move everything to where it is. Call it inside `atomic()`, so that no page sees half of it."""
        for number, seen in enumerate(picture.sensors):
            self._figure(number, seen.sensor).show(seen, shown.sensors)
        self._bones.move(place_bones(picture.body, BONE_INDICES, FUSED_M))
        self._joints.move(place_balls(picture.body, 1.5 * FUSED_M))
        self._show_bounds(picture, shown.bounds)
        self._mirrored.move(place_bones(picture.mirrored, ARM_BONES, MIRRORED_M))
        self._exo.move(place_bones(picture.exo, ARM_BONES, EXO_M))
        self._lay_floor(picture.body)

    def _figure(self, number: int, sensor: str) -> _SensorFigure:
        if sensor not in self._sensors:
            self._sensors[sensor] = _SensorFigure(self._scene, number, sensor)
        return self._sensors[sensor]

    def _show_bounds(self, picture: Picture, visible: bool) -> None:
        self._bounds.handle.visible = visible
        if visible and picture.shape_m2:
            self._bounds.move(place_bounds(picture.body, picture.shape_m2))

    def _lay_floor(self, joints: Array) -> None:
        """Under the lowest joint ever seen: no sensor tells where the floor is."""
        if np.isfinite(joints).any():
            lowest = float(np.nanmin(joints[:, 1]))
            x, y, z = self._floor.position
            if lowest < y:
                self._floor.position = (x, lowest, z)
