"""The 3-D view: pieces where they belong, and viser reached only through our own door."""

import msgspec
import numpy as np
import psutil
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from server.api.view3d_shapes import HIDDEN, as_array, facing, place_balls, place_bones, place_bounds

coordinates = st.floats(-5, 5, width=32)
points = st.tuples(coordinates, coordinates, coordinates)
BONE = np.array([(0, 1)])


def turned(wxyz, vector):
    return Rotation.from_quat(wxyz, scalar_first=True).apply(vector)


@given(points, points)
def test_a_bone_reaches_from_joint_to_joint(start, end):
    joints = as_array((start, end))
    placed = place_bones(joints, BONE, 0.02)
    length = float(np.linalg.norm(joints[1] - joints[0]))
    if length < 1e-3:
        return
    half = turned(placed.wxyzs[0], (0, 0, placed.scales[0, 2] / 2))
    assert placed.positions[0] - half == pytest.approx(joints[0], abs=1e-4)
    assert placed.positions[0] + half == pytest.approx(joints[1], abs=1e-4)


@pytest.mark.parametrize("missing", [0, 1])
def test_a_bone_without_an_end_is_hidden(missing):
    joints = [(0.0, 0.0, 1.0), (0.0, 1.0, 1.0)]
    joints[missing] = None
    placed = place_bones(as_array(tuple(joints)), BONE, 0.02)
    assert np.all(placed.scales == np.float32(HIDDEN))
    assert np.isfinite(placed.positions).all()


def test_a_missing_joint_is_hidden():
    placed = place_balls(as_array(((0.0, 0.0, 1.0), None)), 0.03)
    assert placed.scales[0] == pytest.approx(0.03)
    assert placed.scales[1] == pytest.approx(HIDDEN)


@given(st.lists(st.floats(-0.3, 0.3), min_size=9, max_size=9))
def test_a_bound_fills_its_set(numbers):
    root = np.array(numbers).reshape(3, 3)
    shape = root @ root.T + 1e-4 * np.eye(3)
    xx, xy, xz, yy, yz, zz = shape[np.triu_indices(3)]
    placed = place_bounds(as_array(((1.0, 2.0, 3.0),)), ((xx, xy, xz, yy, yz, zz),))
    axes = turned(placed.wxyzs[0], np.diag(placed.scales[0]))
    for axis in axes:  # each end lies on the surface x' shape⁻¹ x = 1
        assert axis @ np.linalg.solve(shape, axis) == pytest.approx(1.0, abs=1e-2)


def test_a_sensors_figure_looks_at_the_person():
    wxyz = facing(np.array([2.0, 1.0, 0.0]), np.array([0.0, 0.0, 2.0]))
    assert turned(wxyz, (0, 0, 1)) == pytest.approx([-(0.5**0.5), 0, 0.5**0.5], abs=1e-6)
    assert turned(wxyz, (0, 1, 0)) == pytest.approx([0, -1, 0], abs=1e-6)


# ---------------------------------------------------------------- behind the door


def test_visers_page_comes_through_with_rules_of_its_own(therapist):
    page = therapist.get("/view3d/")
    assert page.status_code == 200
    assert "<title>Viser</title>" in page.text
    assert "frame-ancestors 'self'" in page.headers["content-security-policy"]
    assert therapist.get("/view3d").headers["location"] == "/view3d/"
    assert page.text.count(".mantine-Notifications-root, .mantine-Paper-root") == 1


def test_a_person_chooses_what_the_view_shows(shared, therapist):
    chosen = {"sensors": False, "bounds": True}
    assert therapist.put("/api/view3d", json=chosen).json() == chosen
    assert (shared.service.view3d.shown.sensors, shared.service.view3d.shown.bounds) == (False, True)
    assert therapist.put("/api/view3d", json={"sensors": "maybe", "bounds": True}).status_code == 422
    therapist.put("/api/view3d", json={"sensors": True, "bounds": False}).raise_for_status()


@pytest.mark.parametrize("path", ["/view3d", "/view3d/"])
def test_visers_socket_comes_through_and_the_scene_moves(shared, therapist, visers_page, path):
    with visers_page(shared, therapist, path) as page:
        assert page.socket.subprotocol == "viser-v1.1.1"
        page.look()
        page.wait_until_moved({"/fused/bones", "/fused/joints", "/exoskeleton", "/sensors/0/bones"})


def test_nobody_opens_a_public_tunnel_through_the_view(shared, therapist, visers_page, monkeypatch):
    asked = []
    monkeypatch.setattr("viser._viser.ViserTunnel", lambda *_, **__: asked.append(True))
    with visers_page(shared, therapist, "/view3d") as page:
        page.socket.send(msgspec.msgpack.encode({"type": "ShareUrlRequest"}))
        page.look()
        while not shared.service.view3d._server.get_clients():
            page.socket.recv(timeout=20)
    assert asked == []


def test_viser_listens_on_this_machine_only(shared):
    mine = [c for c in psutil.Process().net_connections("tcp") if c.status == "LISTEN"]
    ours = [c.laddr.ip for c in mine if c.laddr.port == shared.service.view3d.port]
    assert ours == ["127.0.0.1"]
