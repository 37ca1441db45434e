"""The compiled simulator. N environments, M body magnets, A action components, O observation components,
D drive magnets, K rod nodes.

Arrays may be given as anything that NumPy makes an array of, of a type that converts without loss:
float32 for float64, whole numbers that are not negative for uint64. What cannot be used is a TypeError or
ValueError that names the argument, its value and what is allowed.

Calls that can be long release Python's lock and use all threads; a batch that another call is changing
meanwhile raises RuntimeError. Ctrl-C, as any signal whose handler raises, stops them within some hundredths
of a second, and what they work on is then as before. Memory that is not there is a MemoryError, raised
beforehand."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "PRESETS",
    "Batch",
    "Scene",
    "SceneError",
    "Specification",
    "Trajectories",
    "__version__",
    "_rebuild_batch",
    "_stops_cleanly",
    "atan2",
    "cuboid_field",
    "cuboid_wrench",
    "record_scenes",
    "sin_cos",
]

__version__: str
PRESETS: tuple[str, ...]

class SceneError(ValueError):
    """A scene that cannot be simulated: names the field, the value, the unit and what is allowed."""

    field: str | None = None
    """Dotted path of the field; None where it is no field that is wrong."""
    line: int | None = None
    """Line of the TOML text, from 1; None for a scene that was not read from text."""

@final
class Scene:
    """A validated scene: immutable, equal to others by value, usable as a key."""

    @staticmethod
    def from_toml(text: str) -> Scene:
        """Parses and validates a scene. Raises SceneError."""
    @staticmethod
    def preset(name: str) -> Scene:
        """One of PRESETS. Raises SceneError."""
    @staticmethod
    def ensemble(name: str) -> list[Scene]:
        """Robots of one shape that fit the same measurements; a batch takes all of them. Raises SceneError,
        which tells the names that exist."""
    def with_values(self, values: Mapping[str, Any]) -> Scene:
        """A copy with fields replaced, by dotted path: {"ground.static_friction": 0.9}, or
        {"body.segment[2].thickness_m": 0.006} in a list, counted from 0. A mapping replaces a whole
        table, None removes an optional one. Scalars and arrays of NumPy are taken as numbers and lists.
        Raises SceneError; ValueError or TypeError for a value that no scene can hold."""
    def in_segments(self) -> Scene:
        """The same scene with its body as a list of segments, to be changed one by one. It gives the same
        trajectories, bit for bit, but for clamped rods that hold magnets; observations are scaled by the
        mean pitch of the magnets."""
    def to_toml(self) -> str: ...
    def explain(self, *, measure: bool = False) -> str:
        """Terms compiled into the model, and those left out with the reason. With measure also the share
        of each phase of a step, see shares."""
    def shares(self) -> dict[str, float]:
        """Phases of a solver step, each with its share of the step's time; they sum to 1. What the scene
        lacks has no phase. Measured on this machine over 200 steps of eight robots with random actions,
        the least of three runs; times differ between measurements by some per cent."""
    def explicit_limit(self) -> tuple[float, str]:
        """The largest stable step of the explicit scheme for this body [s], whatever scheme the scene asks
        for, and what limits it. A scene with a longer explicit step is refused."""
    @property
    def name(self) -> str: ...
    @property
    def dimensions(self) -> int:
        """2: the plane x-y; 3: space."""
    @property
    def magnets(self) -> int:
        """Number of body magnets M, removed ones included."""
    @property
    def removed(self) -> tuple[int, ...]: ...
    @property
    def body_length_m(self) -> float: ...
    @property
    def control_step_s(self) -> float: ...
    @property
    def episode_s(self) -> float: ...
    @property
    def controlled(self) -> bool:
        """Whether the drive follows actions."""
    @property
    def stage_limits(self) -> dict[str, float] | None:
        """reach_m, lowest_m, highest_m, speed_m_s, acceleration_m_s2 of a controlled drive; in space also
        lateral_reach_m, yaw_reach_deg, yaw_speed_deg_s, yaw_acceleration_deg_s2."""
    @property
    def geometry(self) -> dict[str, Any]:
        """Sizes for drawing: node_thickness_m (K), element_thickness_m and element_width_m (K − 1),
        magnet_size_m (M, 3): length, height, width; magnet_offset_m (M, 3): centre from that of its
        body, along it, up and to its side; magnet_direction (M, 3): of the remanence, along the same;
        polarity (M): −1 straight down, else 1; drive_size_m (length, height), drive_width_m, ground
        (bool), incline_deg."""
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...

@final
class Specification:
    """One named slice of an observation or action row."""

    @property
    def name(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def size(self) -> int: ...
    @property
    def low(self) -> float: ...
    @property
    def high(self) -> float: ...
    @property
    def description(self) -> str: ...

@final
class Batch:
    """N environments of one scene, or of several, advanced together."""

    def __new__(
        cls,
        scene: Scene | Sequence[Scene],
        num_envs: int,
        *,
        lanes: Literal["wide", "scalar"] = "wide",
        threads: int | None = None,
    ) -> Batch:
        """lanes: "wide" (8, single precision 16) or "scalar"; equal bits. threads: None: all. Raises
        MemoryError for more environments than there is memory for.

        A list of S scenes gives environment i the scene i S // N; each is bit for bit what it is in a
        batch of its scene alone. Scenes must have one shape: dimensions, precision, solver step,
        control step and episode, numbers of magnets, nodes and drive magnets, parts of actions and
        observations with their units; all else may differ. Raises SceneError, which names what does not
        fit. Lanes stand idle in the last block of a scene whose share of N is no multiple of them."""
    @property
    def scene(self) -> Scene:
        """The first of scenes, whose shape all have."""
    @property
    def scenes(self) -> tuple[Scene, ...]: ...
    @property
    def scene_indices(self) -> NDArray[np.int64]:
        """(N,): which of scenes each environment has."""
    @property
    def num_envs(self) -> int: ...
    @property
    def observation_specification(self) -> tuple[Specification, ...]: ...
    @property
    def action_specification(self) -> tuple[Specification, ...]: ...
    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Those that act in every scene of the batch."""
    def set_parameter(self, name: str, factors: ArrayLike) -> None:
        """Factors (N,) of the scene's value, in force from the next reset on; only 1 of a term that the scene
        of an environment leaves out. Raises ValueError."""
    def parameter(self, name: str) -> NDArray[np.float64]:
        """Factors (N,) as set (without what a reset draws)."""
    def set_magnets_present(self, present: ArrayLike) -> None:
        """(N, M): False takes a magnet out, in force from the next reset on. Raises ValueError."""
    def magnets_present(self) -> NDArray[np.bool_]: ...
    def reset(
        self,
        mask: ArrayLike,
        seeds: ArrayLike,
        episodes: ArrayLike,
        start: ArrayLike | None = None,
    ) -> None:
        """Resets the environments of mask (N,). Random draws depend on (seed, episode) of the
        environment alone. start (N, 3): x [m], height [m], angle [rad]; in space (N, 5), with z [m] and
        yaw [rad]; None, or a row of NaN: the scene's. The body is bent as the scene says, whatever its
        pose."""
    def step(self, actions: ArrayLike) -> tuple[NDArray[np.float32], NDArray[np.float64], NDArray[np.uint8]]:
        """One control step. actions (N, A) in [-1, 1], clipped. Returns fresh arrays: observations
        (N, O), progress towards the head in this step [m] (N,), status (N,): 0 running, others see
        status_text. Broken environments stand still until reset. Raises ValueError for a wrong
        shape or a value that is not finite, naming the environment; the state is then untouched."""
    def rollout(
        self, actions: ArrayLike, *, observations: bool = False, magnet_poses: bool = False
    ) -> Trajectories:
        """T control steps in one call, bit for bit as T calls of step. actions (T, N, A) in [-1, 1],
        clipped. Each block of lanes runs its whole trajectory in one task of the thread pool. Broken
        environments stand still, nothing is reset. The batch is left at the end of the trajectories; to
        leave it where it is, roll out its copies. Raises ValueError for a wrong shape or a value that is
        not finite; the state is then untouched."""
    def copies(self, environments: ArrayLike) -> Batch:
        """A batch of its own, with the same lanes and threads, whose environment k is a copy of
        environments[k] of this one, bit for bit: state, and settings for the next reset. An environment
        may be copied any number of times. Raises ValueError for an index outside 0 to N - 1."""
    def advance(self, duration_s: float) -> None:
        """Lets a scene whose drive is not controlled run for a whole number of solver steps."""
    def observe(self) -> NDArray[np.float32]: ...
    def status(self) -> NDArray[np.uint8]: ...
    @staticmethod
    def status_text(code: int) -> str: ...
    def time_s(self) -> NDArray[np.float64]: ...
    def magnet_poses(self) -> NDArray[np.float64]:
        """(N, M, 3): x [m], y [m], angle [rad] in the world; in space (N, M, 7): x, y, z [m] and the
        quaternion w, x, y, z, w ≥ 0, that turns x, y, z into the magnet's tangent, up and side."""
    def magnet_velocities(self) -> NDArray[np.float64]:
        """(N, M, 3): [m/s], [m/s], [rad/s]; in space (N, M, 6): along and about x, y, z."""
    def magnet_wrenches(self) -> NDArray[np.float64]:
        """Force [N] and torque about its middle [N·m] of drive, field and other magnets on each body, as the
        next step takes them: (N, M, 3), F_x, F_y, T_z; in space (N, M, 6)."""
    def node_positions(self) -> NDArray[np.float64]:
        """(N, K, 2), in space (N, K, 3) [m]: the centre line, head first."""
    def drive_positions(self) -> NDArray[np.float64]:
        """(N, D, 2) [m]: centres of the drive magnets; in space (N, D, 4), with z [m] and yaw [rad]."""
    def drive_velocities(self) -> NDArray[np.float64]:
        """(N, 2) [m/s]; in space (N, 4), along x, y, z and of yaw [rad/s]."""
    def robot_poses(self) -> NDArray[np.float64]:
        """(N, 3): x, z of the robot's centre [m] and its heading [rad], the yaw of the line from its head
        to its tail, from -π to π; in the plane z and heading are 0."""
    def counters(self) -> dict[str, int]:
        """Work since construction, counted per block of lanes: steps, factorisations, trials, wrenches."""
    def get_state(self) -> bytes:
        """Everything that changes in time, bit for bit."""
    def set_state(self, state: bytes) -> None:
        """Raises ValueError for a state of other scenes or another size; nothing is changed then."""
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Trajectories:
    """What Batch.rollout saw after each of T control steps."""

    @property
    def progress_m(self) -> NDArray[np.float64]:
        """(T, N) [m]: progress towards the head in the control step."""
    @property
    def status(self) -> NDArray[np.uint8]:
        """(T, N): as Batch.step gives it."""
    @property
    def robot_poses(self) -> NDArray[np.float64]:
        """(T, N, 3): as Batch.robot_poses gives them."""
    @property
    def magnet_poses(self) -> NDArray[np.float64] | None:
        """(T, N, M, 3 or 7): as Batch.magnet_poses gives them; None where they were not asked for."""
    @property
    def observations(self) -> NDArray[np.float32] | None:
        """(T, N, O): as Batch.step gives them; None where they were not asked for."""

def _rebuild_batch(
    scenes: Sequence[Scene], scene_indices: ArrayLike, lanes: str, threads: int | None, state: bytes
) -> Batch:
    """Makes a batch again from what Batch.__reduce__ kept."""

def atan2(y: ArrayLike, x: ArrayLike) -> NDArray[np.float64]:
    """Angles of the vectors (x, y) from -π to π [rad], the same bits on every platform; NumPy's are not.
    Raises ValueError for two shapes."""

def _stops_cleanly() -> bool:
    """Whether a signal's handler runs now inside a call that stops, and changes nothing, where it raises."""

def cuboid_field(size_m: ArrayLike, magnetisation_t: ArrayLike, points_m: ArrayLike) -> NDArray[np.float64]:
    """Flux density (…, 3) [T] at points (…, 3) [m] of a cuboid at the origin with remanence (…, 3) [T].
    Raises ValueError for other shapes."""

def cuboid_wrench(
    drive_size_m: ArrayLike,
    body_size_m: ArrayLike,
    position_m: ArrayLike,
    quaternion: ArrayLike,
    drive_magnetisation_t: ArrayLike,
    body_magnetisation_t: ArrayLike,
    order: int,
    model: str,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Force (…, 3) [N] and torque (…, 3) [N·m] on bodies at positions (…, 3) [m] with orientations
    (…, 4) w, x, y, z and remanences (…, 3) [T]; order 1 to 10; model "cuboid" or "dipole". Raises ValueError
    for magnets that overlap, for quaternions of length 0 and for other shapes."""

def record_scenes(
    scenes: Sequence[Scene],
    duration_s: ArrayLike,
    sample_s: float,
    *,
    nodes: bool = False,
    threads: int | None = None,
) -> list[tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], int]]:
    """Runs each scene once from its start pose, all of them side by side, for one duration
    or each for its own. For each: magnet poses (T, M, 3 or 7), drive positions (T, D, 2 or 4), nodes
    (T, K, 2 or 3; K is 0 where they are not asked for), each as Batch gives them, status at the end. A
    controlled drive stands still. Raises ValueError for times that are no whole number of steps."""

def sin_cos(angle_rad: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Sines and cosines of angles of up to 1000 rad in magnitude, the same bits on every platform; NumPy's
    are not."""
