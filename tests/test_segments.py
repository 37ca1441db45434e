"""Bodies of segments: paths, drawing and the file of a fitted scene."""

import numpy as np
import pytest

from magworm_gym import Batch, Scene, SceneError
from magworm_gym.identification.paths import scene_numbers
from magworm_gym.identification.scene_file import commented_scene

SEGMENTS = Scene.preset("paper-3").in_segments()


def test_a_worm_in_segments_is_the_same_robot() -> None:
    short, long = Batch(Scene.preset("paper-3"), 1), Batch(SEGMENTS, 1)
    np.testing.assert_array_equal(short.node_positions(), long.node_positions())
    assert SEGMENTS.magnets == 3 and SEGMENTS == Scene.from_toml(SEGMENTS.to_toml())


def test_one_field_of_one_segment_is_replaced() -> None:
    scene = SEGMENTS.with_values(
        {"body.segment[2].thickness_m": 0.006, "body.segment[4].magnet.length_m": 0.008}
    )
    thickness = scene.geometry["element_thickness_m"]
    assert thickness.count(0.006) == 3 and thickness.count(0.007) == 6
    untouched_m = SEGMENTS.geometry["magnet_size_m"][0][0]
    assert [size[0] for size in scene.geometry["magnet_size_m"]] == [untouched_m, untouched_m, 0.008]
    with pytest.raises(SceneError, match=r"body.segment is a list of 5; allowed: 8 entries or more"):
        SEGMENTS.with_values({"body.segment[7].thickness_m": 0.006})


def test_the_file_of_a_fitted_scene_comments_on_one_segment() -> None:
    origins = {"body.segment[2].thickness_m": "fitted", "body.segment[4].magnet": "measured", "body": "drawn"}
    text = commented_scene(SEGMENTS, origins, "kept", [])
    assert Scene.from_toml(text) == SEGMENTS
    assert text.count("# fitted") == 1 and text.count("thickness_m = 0.007  # drawn") == 2
    magnet = text.split("[body.segment.magnet]")[-1].split("[[")[0].split("\n[")[0]
    assert magnet.count("# measured") == magnet.count(" = ")
    assert f"youngs_modulus_pa = {scene_numbers(SEGMENTS)['material.youngs_modulus_pa']}  # kept" in text


@pytest.mark.parametrize("dimensions", [2, 3])
def test_segments_are_drawn(dimensions: int) -> None:
    pytest.importorskip("PIL")
    from magworm_gym.recording import Moment
    from magworm_gym.render import view_of

    scene = SEGMENTS.with_values({"dimensions": dimensions, "body.segment[2].width_m": 0.02})
    batch = Batch(scene, 1)
    frame = view_of(scene, 320, 200).draw(
        Moment(
            batch.node_positions()[0],
            batch.magnet_poses()[0],
            batch.magnets_present()[0],
            np.zeros((0, 2 if dimensions == 2 else 4)),
            np.zeros((0, dimensions)),
        )
    )
    assert frame.shape == (200, 320, 3)
