"""Compute the pictures of toys that come with the template of a study for children: run it without arguments.

Each picture stands for a photo that a lab takes itself. A toy is a few solids, each given by the distance of a point to
its surface; rays are marched towards them ("sphere tracing", Hart 1996) and lit by one lamp with a soft shadow.
"""

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QImage

Array = NDArray[np.float64]
Solid = Callable[[Array], Array]
"""Distance of points, of shape (n, 3), to a surface; negative inside."""

FOLDER = Path(__file__).resolve().parent.parent / "assets" / "templates" / "children" / "cards"
SIDE_PX = 480
SAMPLES = 2  # rays along each side of a pixel
STEPS = 96
FAR = 14.0
NEAR = 1e-3

LAMP = np.array([-0.55, 0.75, 0.55]) / np.linalg.norm([-0.55, 0.75, 0.55])
EYE = np.array([0.0, 2.3, 5.2])
TARGET = np.array([0.0, 0.78, 0.0])
ZOOM = 3.3

RED, ORANGE, YELLOW = (0.80, 0.16, 0.12), (0.93, 0.47, 0.10), (0.97, 0.77, 0.18)
GREEN, BLUE, PURPLE = (0.20, 0.53, 0.22), (0.13, 0.36, 0.72), (0.48, 0.25, 0.60)
WHITE, CREAM, BROWN, BLACK = (0.95, 0.95, 0.93), (0.96, 0.89, 0.74), (0.46, 0.27, 0.13), (0.07, 0.07, 0.08)
PINK = (0.93, 0.52, 0.62)


@dataclass(frozen=True)
class Part:
    """A solid of one colour."""

    solid: Solid
    colour: tuple[float, float, float]


def norm(points: Array) -> Array:
    """Return the lengths of vectors, of shape (n,)."""
    found: Array = np.sqrt(np.sum(points * points, axis=-1))
    return found


def ball(x: float, y: float, z: float, radius: float) -> Solid:
    """Return a sphere."""
    return lambda p: norm(p - (x, y, z)) - radius


def box(centre: Sequence[float], half: Sequence[float], rounding: float = 0.04, turn: float = 0.0) -> Solid:
    """Return a box with round edges, turned about its upright axis by ``turn`` radians."""
    cos, sin = np.cos(turn), np.sin(turn)

    def distance(p: Array) -> Array:
        q = p - np.asarray(centre)
        q = np.stack((cos * q[:, 0] - sin * q[:, 2], q[:, 1], sin * q[:, 0] + cos * q[:, 2]), axis=-1)
        q = np.abs(q) - (np.asarray(half) - rounding)
        found: Array = norm(np.maximum(q, 0.0)) + np.minimum(np.max(q, axis=-1), 0.0) - rounding
        return found

    return distance


def cylinder(centre: Sequence[float], radius: float, half: float, rounding: float = 0.04) -> Solid:
    """Return an upright cylinder with round edges; ``half`` is half its height."""

    def distance(p: Array) -> Array:
        q = p - np.asarray(centre)
        across = np.hypot(q[:, 0], q[:, 2]) - radius + rounding
        along = np.abs(q[:, 1]) - half + rounding
        outside = np.hypot(np.maximum(across, 0.0), np.maximum(along, 0.0))
        found: Array = np.minimum(np.maximum(across, along), 0.0) + outside - rounding
        return found

    return distance


def cone(bottom: float, top: float, wide: float, narrow: float) -> Solid:
    """Return a cone cut off at both ends, upright on the axis."""

    def distance(p: Array) -> Array:
        share = np.clip((p[:, 1] - bottom) / (top - bottom), 0.0, 1.0)
        slope = (top - bottom) / np.hypot(top - bottom, wide - narrow)
        side = (np.hypot(p[:, 0], p[:, 2]) - (wide + share * (narrow - wide))) * slope
        found: Array = np.maximum(side, np.maximum(bottom - p[:, 1], p[:, 1] - top)) - 0.02
        return found

    return distance


def ring(centre: Sequence[float], radius: float, thick: float, *, upright: bool = False) -> Solid:
    """Return a torus that lies flat, or stands and faces the eye."""

    def distance(p: Array) -> Array:
        q = p - np.asarray(centre)
        flat = np.hypot(q[:, 0], q[:, 1 if upright else 2]) - radius
        found: Array = np.hypot(flat, q[:, 2 if upright else 1]) - thick
        return found

    return distance


def star(centre: Sequence[float], outer: float, inner: float, half: float) -> Solid:
    """Return a star of five points that faces the eye."""
    corners = np.array(
        [
            (
                (outer if k % 2 == 0 else inner) * np.sin(k * np.pi / 5),
                (outer if k % 2 == 0 else inner) * np.cos(k * np.pi / 5),
            )
            for k in range(10)
        ]
    )

    def distance(p: Array) -> Array:
        q = (p - np.asarray(centre))[:, :2]
        nearest = np.full(len(q), np.inf)
        inside = np.zeros(len(q), dtype=bool)
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            edge, to = b - a, q - a
            share = np.clip(to @ edge / (edge @ edge), 0.0, 1.0)
            nearest = np.minimum(nearest, np.hypot(*(to - share[:, None] * edge).T))
            crosses = (a[1] > q[:, 1]) != (b[1] > q[:, 1])
            with np.errstate(divide="ignore", invalid="ignore"):
                left = q[:, 0] < (b[0] - a[0]) * (q[:, 1] - a[1]) / (b[1] - a[1]) + a[0]
            inside ^= crosses & left
        flat = np.where(inside, -nearest, nearest) + 0.08
        deep = np.abs(p[:, 2] - centre[2]) - half + 0.08
        return np.minimum(np.maximum(flat, deep), 0.0) + np.hypot(np.maximum(flat, 0), np.maximum(deep, 0)) - 0.08

    return distance


def without(one: Solid, other: Solid) -> Solid:
    """Return a solid from which another one is cut out."""
    return lambda p: np.maximum(one(p), -other(p))


def both(one: Solid, other: Solid) -> Solid:
    """Return what lies in both solids."""
    return lambda p: np.maximum(one(p), other(p))


def half_space(height: float, *, above: bool = True) -> Solid:
    """Return all that lies above a height, or below it."""
    return lambda p: (height - p[:, 1]) if above else (p[:, 1] - height)


def toys() -> dict[str, tuple[tuple[float, float, float], list[Part]]]:
    """Return for each toy the colour of the table and its parts."""
    beach = ball(0, 0.85, 0, 0.85)
    stripe = both(ball(0, 0.85, 0, 0.86), box((0, 0.85, 0), (0.9, 0.22, 0.9), 0.0))
    pips = [(-0.28, 1.34, 0.28), (0.28, 1.34, -0.28), (0, 1.34, 0)]
    die = box((0, 0.68, 0), (0.66, 0.66, 0.66), 0.14)
    sprinkles = [
        (0.62 * np.sin(a) * r, 0.85 + 0.62 * np.cos(a) * r, 0.33)
        for a, r in zip(np.arange(12) * 2.4, (0.86, 1.0, 1.16) * 4, strict=True)
    ]
    return {
        "ball": ((0.55, 0.72, 0.80), [Part(beach, RED), Part(stripe, WHITE)]),
        "cup": (
            (0.85, 0.70, 0.50),
            [
                Part(without(cylinder((-0.15, 0.75, 0), 0.62, 0.75), cylinder((-0.15, 0.95, 0), 0.52, 0.75)), BLUE),
                Part(both(ring((0.50, 0.78, 0), 0.36, 0.10, upright=True), lambda p: 0.50 - p[:, 0]), BLUE),
            ],
        ),
        "dice": (
            (0.45, 0.62, 0.50),
            [Part(die, WHITE)]
            + [
                Part(both(ball(x, y, z, 0.12), box((0, 0.68, 0), (0.665, 0.665, 0.665), 0.14)), BLACK)
                for x, y, z in pips
            ]
            + [
                Part(both(ball(x, 0.68 + y, 0.66, 0.12), box((0, 0.68, 0), (0.665, 0.665, 0.665), 0.14)), BLACK)
                for x in (-0.28, 0.28)
                for y in (-0.28, 0.28)
            ],
        ),
        "doughnut": (
            (0.80, 0.83, 0.66),
            [Part(ring((0, 0.85, 0), 0.58, 0.28, upright=True), BROWN)]
            + [Part(ring((0, 0.85, 0.07), 0.58, 0.25, upright=True), PINK)]
            + [
                Part(ball(x, y, z, 0.05), colour)
                for (x, y, z), colour in zip(sprinkles, (WHITE, YELLOW, BLUE) * 4, strict=True)
            ],
        ),
        "house": (
            (0.58, 0.70, 0.45),
            [
                Part(box((0, 0.5, 0), (0.75, 0.5, 0.6)), CREAM),
                Part(
                    both(
                        both(
                            box((0, 1.3, 0), (1.0, 0.65, 0.7), 0.0),
                            lambda p: (p[:, 1] - 1.72 + np.abs(p[:, 0]) * 0.8) * 0.75,
                        ),
                        half_space(0.98),
                    ),
                    RED,
                ),
                Part(box((0.0, 0.34, 0.6), (0.17, 0.34, 0.04), 0.02), BROWN),
                Part(box((-0.45, 0.55, 0.6), (0.14, 0.16, 0.03), 0.02), BLUE),
                Part(box((0.45, 0.55, 0.6), (0.14, 0.16, 0.03), 0.02), BLUE),
                Part(box((0.45, 1.5, -0.1), (0.11, 0.3, 0.11), 0.02), BROWN),
            ],
        ),
        "mushroom": (
            (0.52, 0.60, 0.38),
            [
                Part(cone(0.0, 0.85, 0.34, 0.24), CREAM),
                Part(both(ball(0, 0.75, 0, 0.82), half_space(0.78)), RED),
            ]
            + [
                Part(both(ball(0.82 * x, 0.75 + 0.82 * y, 0.82 * z, 0.15), ball(0, 0.75, 0, 0.84)), WHITE)
                for x, y, z in (
                    (0, 0.72, 0.69),
                    (-0.62, 0.5, 0.6),
                    (0.62, 0.5, 0.6),
                    (-0.35, 0.93, 0.1),
                    (0.4, 0.9, 0.1),
                    (0.05, 0.28, 0.96),
                )
            ],
        ),
        "snowman": (
            (0.36, 0.50, 0.66),
            [
                Part(ball(0, 0.55, 0, 0.58), WHITE),
                Part(ball(0, 1.28, 0, 0.42), WHITE),
                Part(cylinder((0, 1.66, 0), 0.46, 0.05, 0.02), BLACK),
                Part(cylinder((0, 1.86, 0), 0.30, 0.22, 0.02), BLACK),
                Part(ball(-0.15, 1.36, 0.37, 0.05), BLACK),
                Part(ball(0.15, 1.36, 0.37, 0.05), BLACK),
                Part(ball(0, 1.24, 0.44, 0.08), ORANGE),
                Part(ball(0, 0.72, 0.56, 0.05), BLACK),
                Part(ball(0, 0.50, 0.58, 0.05), BLACK),
                Part(ring((0, 1.0, 0), 0.34, 0.09), RED),
            ],
        ),
        "star": ((0.42, 0.36, 0.60), [Part(star((0, 0.92, 0), 0.98, 0.46, 0.24), YELLOW)]),
        "tree": (
            (0.80, 0.74, 0.62),
            [
                Part(cylinder((0, 0.2, 0), 0.15, 0.22), BROWN),
                Part(cone(0.36, 1.0, 0.80, 0.22), GREEN),
                Part(cone(0.84, 1.42, 0.60, 0.14), GREEN),
                Part(cone(1.26, 1.86, 0.42, 0.02), GREEN),
            ],
        ),
        "tower": (
            (0.68, 0.55, 0.42),
            [
                Part(ring((0, 0.20, 0), 0.58, 0.20), PURPLE),
                Part(ring((0, 0.56, 0), 0.46, 0.18), BLUE),
                Part(ring((0, 0.88, 0), 0.36, 0.16), GREEN),
                Part(ring((0, 1.16, 0), 0.26, 0.14), YELLOW),
                Part(ball(0, 1.46, 0, 0.24), RED),
                Part(cylinder((0, 0.7, 0), 0.12, 0.7), CREAM),
            ],
        ),
    }


def render(table: Sequence[float], parts: Sequence[Part]) -> NDArray[np.uint8]:
    """Return the picture, of shape (SIDE_PX, SIDE_PX, 3), in sRGB."""
    side = SIDE_PX * SAMPLES
    across = (np.arange(side) + 0.5) / side * 2 - 1
    ahead = (TARGET - EYE) / norm(TARGET - EYE)
    right = np.cross(ahead, (0.0, 1.0, 0.0))
    right /= norm(right)
    up = np.cross(right, ahead)
    x, y = np.meshgrid(across, -across)
    rays = x[..., None] * right + y[..., None] * up + ZOOM * ahead
    rays = (rays / norm(rays)[..., None]).reshape(-1, 3)

    def distances(points: Array) -> Array:
        return np.stack([part.solid(points) for part in parts] + [points[:, 1]])

    travelled = march(lambda p: distances(p).min(axis=0), np.broadcast_to(EYE, rays.shape), rays)
    points = EYE + travelled[:, None] * rays
    nearest = distances(points).argmin(axis=0)
    normals = np.stack(
        [distances(points + step).min(axis=0) - distances(points - step).min(axis=0) for step in np.eye(3) * 5e-4],
        axis=-1,
    )
    normals /= np.maximum(norm(normals), 1e-9)[:, None]
    colours = np.array([part.colour for part in parts] + [tuple(table)])[nearest]
    on_table = nearest == len(parts)
    grain = 0.04 * np.sin(points[:, 0] * 9 + 1.3 * np.sin(points[:, 2] * 2.1)) + 0.02 * np.sin(points[:, 0] * 41)
    grain *= np.exp(-((travelled / 7) ** 4))  # far away it would be finer than a pixel
    colours = np.where(on_table[:, None], colours * (1 + grain)[:, None], colours)

    lit = shadow(lambda p: distances(p)[:-1].min(axis=0), points + normals * 0.01)
    lamp = np.clip(normals @ LAMP, 0.0, 1.0) * lit
    sky = 0.5 + 0.5 * normals[:, 1]
    near_table = np.clip(0.35 + points[:, 1] * 1.2, 0.0, 1.0)
    light = 0.95 * lamp[:, None] * np.array((1.0, 0.95, 0.86)) + 0.42 * (sky * np.where(on_table, 1.0, near_table))[
        :, None
    ] * np.array((0.86, 0.93, 1.0))
    half = LAMP - rays
    half /= norm(half)[:, None]
    shine = np.where(on_table, 0.05, 0.35) * np.clip(np.sum(normals * half, axis=-1), 0.0, 1.0) ** 60 * lit
    seen = colours**1.6 * light + shine[:, None]
    seen = seen.reshape(SIDE_PX, SAMPLES, SIDE_PX, SAMPLES, 3).mean(axis=(1, 3))
    centre = np.hypot(*np.meshgrid(np.linspace(-1, 1, SIDE_PX), np.linspace(-1, 1, SIDE_PX)))
    seen *= (1 - 0.16 * np.clip(centre - 0.4, 0, None) ** 2)[..., None]
    found: NDArray[np.uint8] = (np.clip(seen, 0, 1) ** (1 / 2.0) * 255 + 0.5).astype(np.uint8)
    return found


def march(distance: Solid, start: Array, rays: Array) -> Array:
    """Return how far each ray goes before it meets a surface."""
    travelled = np.zeros(len(rays))
    going = np.arange(len(rays))
    for _ in range(STEPS):
        step = distance(start[going] + travelled[going, None] * rays[going])
        travelled[going] += step * 0.9
        going = going[(step > NEAR) & (travelled[going] < FAR)]
        if not len(going):
            break
    return np.minimum(travelled, FAR)


def shadow(distance: Solid, points: Array) -> Array:
    """Return the share of the lamp that reaches each point; the shadow's edge is soft."""
    share = np.ones(len(points))
    travelled = np.full(len(points), 0.02)
    for _ in range(48):
        step = distance(points + travelled[:, None] * LAMP)
        share = np.minimum(share, np.clip(9 * step / travelled, 0.0, 1.0))
        travelled += np.clip(step, 0.02, 0.25)
    return share


def main() -> None:
    """Write all pictures, or those whose names are given."""
    FOLDER.mkdir(exist_ok=True)
    wanted = sys.argv[1:]
    for name, (table, parts) in toys().items():
        if wanted and name not in wanted:
            continue
        pixels = np.ascontiguousarray(render(table, parts))
        image = QImage(pixels.tobytes(), SIDE_PX, SIDE_PX, 3 * SIDE_PX, QImage.Format.Format_RGB888)
        if not image.save(str(FOLDER / f"{name}.jpg"), quality=86):
            raise OSError(f"{name}.jpg could not be written to {FOLDER}")


if __name__ == "__main__":
    main()
