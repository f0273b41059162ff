import math

import numpy as np
import pytest

import svnet


def test_the_camera_stands_on_the_half_sphere_and_looks_at_the_centre():
    centre = np.array([0.1, -0.2, 0.05])
    for theta in (0, 45, 135.5, 315):
        for phi in (0, 45, 75, 90):
            pose = svnet.camera_pose(theta, phi, 0.7, centre)
            assert pose.shape == (4, 4) and pose.dtype == np.float64
            t, p = math.radians(theta), math.radians(phi)
            outwards = np.array([math.cos(p) * math.cos(t), math.cos(p) * math.sin(t), math.sin(p)])
            assert pose[:3, 3] == pytest.approx(centre + 0.7 * outwards, abs=1e-15)
            assert pose[:3, 2] == pytest.approx(-outwards, abs=1e-15)
            assert pose[2, 0] == 0 and pose[2, 1] >= 0  # x is level, y points upwards
            assert pose[:3, :3].T @ pose[:3, :3] == pytest.approx(np.eye(3), abs=1e-12)
            assert np.linalg.det(pose[:3, :3]) == pytest.approx(1, abs=1e-12)
            assert pose[3].tolist() == [0, 0, 0, 1]
            # The centre is on the optical axis.
            assert np.linalg.inv(pose) @ [*centre, 1] == pytest.approx([0, 0, 0.7, 1], abs=1e-12)


def test_frames_differ_by_half_a_turn_about_z():
    paper = svnet.camera_pose(30, 60, 1, (0, 0, 0), frame="paper")
    assert np.array_equal(paper, svnet.camera_pose(30, 60, 1, (0, 0, 0)))
    optical = svnet.camera_pose(30, 60, 1, (0, 0, 0), "optical")
    assert np.array_equal(optical, paper * [-1, -1, 1, 1])


def test_the_top_view_keeps_the_direction_of_x():
    assert svnet.camera_pose(90, 90, 1, [0, 0, 0])[:3, 0] == pytest.approx([1, 0, 0], abs=1e-15)


def test_numbers_of_any_type():
    expected = svnet.camera_pose(45, 60, 2, [1, 0, 0])
    given = svnet.camera_pose(np.float32(45), np.int8(60), np.array(2), np.array([1, 9, 0, 9, 0, 9])[::2])
    assert np.array_equal(given, expected)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ((0, 45, 1, (0, 0, 0), "ros"), "the camera frame 'ros' is not known; known: paper, optical"),
        ((0, 45, 1, (0, 0, 0), "\udcff"), r"the camera frame '\\udcff' is not known"),
        ((0, 45, 1, (0, 0, 0), 3), 'frame is no str; expects "paper" or "optical"'),
        ((0, 45, 0, (0, 0, 0)), "the radius is 0 m, expected a positive length"),
        ((0, 45, -1, (0, 0, 0)), "the radius is -1 m, expected a positive length"),
        ((0, 45, math.nan, (0, 0, 0)), "the radius is nan m, expected a positive length"),
        ((0, 45, math.inf, (0, 0, 0)), "the radius is inf m, expected a positive length"),
        ((math.nan, 45, 1, (0, 0, 0)), "theta nan is not finite"),
        ((0, math.inf, 1, (0, 0, 0)), "phi inf is not finite"),
        ((0, 91, 1, (0, 0, 0)), r"phi 91 is outside \[0, 90\] degrees"),
        ((0, 45, 1, (0, math.nan, 0)), "the centre .* is not finite"),
        ((0, 45, 1, (0, 0)), r"centre has shape \(2,\); expects \(3,\)"),
        ((0, 45, 1, "abc"), "centre"),
        (([0], 45, 1, (0, 0, 0)), r"theta_deg has shape \(1,\); expects a number"),
        (("a", 45, 1, (0, 0, 0)), "theta_deg has dtype <U1"),
    ],
)
def test_what_is_refused(arguments, message):
    with pytest.raises(svnet.Error, match=message) as error:
        svnet.camera_pose(*arguments)
    assert "\n" not in str(error.value)


def test_angles_out_of_range_by_rounding_mean_the_bound():
    exact = svnet.camera_pose(0, 90, 1, (0, 0, 0))
    assert np.array_equal(svnet.camera_pose(0, 90.00000250447816, 1, (0, 0, 0)), exact)
