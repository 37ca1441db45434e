"""A film that was never made: tracks of a simulated robot, as DeepLabCut would write them."""

from collections.abc import Sequence
from os import PathLike
from typing import Annotated

import numpy as np
from msgspec import Meta
from msgspec.structs import asdict

from magworm_gym._magworm import Scene
from magworm_gym.arguments import path_of
from magworm_gym.atomic_files import write_text
from magworm_gym.documents import Number, Table, checked
from magworm_gym.identification.camera import Camera
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.recording import Floats, record_scenes

RECORD_S, LONGEST_S = 2e-3, 3600.0
ASTRAY = 20.0
"""How far astray a lost point is, in standard deviations of the noise [1]."""


class Blur(Table, frozen=True):
    """What tracking does to a film.

    Attributes:
        noise_px: Standard deviation of a coordinate [px].
        lost: Share of points that are lost: somewhere else, with a low likelihood [1].
        wrong: Share of points that are somewhere else with a high likelihood [1].
        origin_px: Pixel of the scene's origin.
    """

    noise_px: Annotated[float, Meta(ge=0.0, le=1e4)] = 1.0
    lost: Annotated[float, Meta(ge=0.0, le=1.0)] = 0.03
    wrong: Annotated[float, Meta(ge=0.0, le=1.0)] = 0.005
    origin_px: tuple[Number, Number] = (212.0, 388.0)


def write_example_tracks(
    path: str | PathLike[str],
    scene: Scene,
    duration_s: float,
    camera: Camera,
    parts: Sequence[str],
    *,
    blur: Blur | None = None,
    seed: int = 0,
) -> None:
    """Simulates a scene, looks at it through a camera and writes a CSV file like DeepLabCut's.

    Args:
        path: The file.
        scene: The scene; its drive is not a controlled one.
        duration_s: For how long [s]: a multiple of 2 ms.
        camera: The camera; film and experiment begin together.
        parts: Names of the body magnets from the head, and perhaps of the drive.
        blur: What tracking does to it.
        seed: Seed of the noise.

    Raises:
        ProblemError: A number that no film has.
        ValueError: A duration that is no multiple of 2 ms.
    """
    path = path_of("path", path)
    blur = blur or Blur()
    for each in (camera, blur):
        checked(asdict(each), type(each), mistake=ProblemError)
    checked(duration_s, Annotated[float, Meta(ge=RECORD_S, le=LONGEST_S)], "duration_s", ProblemError)
    checked(seed, Annotated[int, Meta(ge=0, le=2**63 - 1)], "seed", ProblemError)
    run = record_scenes([scene], duration_s, RECORD_S, nodes=False)[0]
    places = np.concatenate([run.magnet_poses[..., :2], run.drive_positions[:, :1]], axis=1)
    frames = np.arange(int(duration_s * camera.frames_per_second + 1e-6) + 1)
    time_s = camera.time_s(frames)
    seen = np.stack(
        [
            [np.interp(time_s, run.time_s, places[:, part, axis]) for axis in (0, 1)]
            for part in range(len(parts))
        ]
    ).transpose(2, 0, 1)
    pixels, likelihood = _blurred(camera.pixels(seen, blur.origin_px), blur, np.random.default_rng(seed))
    header = [
        ["scorer", *["magworm"] * 3 * len(parts)],
        ["bodyparts", *[part for part in parts for _ in range(3)]],
        ["coords", *["x", "y", "likelihood"] * len(parts)],
    ]
    rows = [
        [str(frame), *(f"{number:.4f}" for part in range(len(parts)) for number in (*row[part], sure[part]))]
        for frame, row, sure in zip(frames, pixels, likelihood, strict=True)
    ]
    write_text(path, "".join(",".join(row) + "\n" for row in header + rows))


def _blurred(pixels: Floats, blur: Blur, generator: np.random.Generator) -> tuple[Floats, Floats]:
    """Pixels (F, P, 2) with noise and outliers, and likelihoods (F, P)."""
    shape = pixels.shape[:2]
    noisy = pixels + generator.normal(0.0, blur.noise_px, pixels.shape)
    astray = generator.normal(0.0, ASTRAY * max(blur.noise_px, 1.0), pixels.shape)
    lot = generator.random(shape)
    lost, wrong = lot < blur.lost, (lot >= blur.lost) & (lot < blur.lost + blur.wrong)
    noisy = np.where((lost | wrong)[..., None], pixels + astray, noisy)
    likelihood = np.where(lost, generator.uniform(0.0, 0.5, shape), generator.uniform(0.9, 1.0, shape))
    return noisy, likelihood
