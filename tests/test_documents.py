"""Plain values as typed tables, and the sentences of mistakes."""

from typing import Annotated, Literal

import numpy as np
import pytest
from msgspec import Meta, field

from magworm_gym.documents import Number, Table, Text, checked, parse_toml


class Wheel(Table, frozen=True):
    """A table within another."""

    radius_m: Annotated[float, Meta(ge=0.1, le=2.0)]
    spokes: Annotated[int, Meta(ge=3)] = field(default=8, name="spoke_count")

    def __post_init__(self):
        if self.radius_m > 1.0 and self.spokes < 5:
            raise ValueError(f"spoke_count is {self.spokes}; allowed: 5 or more for a radius_m beyond 1")


class Cart(Table, frozen=True):
    """A table."""

    name: Text
    wheels: tuple[Wheel, ...] = ()
    colour: Literal["red", "blue"] = "red"
    loads: Annotated[tuple[Number, ...], Meta(description="a list of loads")] = ()
    axle: Wheel | None = None
    used: bool = False


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": ""}, "cart.name is ''; allowed: a text"),
        ({"name": None}, "cart.name is None; allowed: a text"),
        ({"colour": "green"}, "cart.colour is 'green'; allowed: red, blue"),
        ({"used": 1}, "cart.used is 1; allowed: true or false"),
        ({"wheels": 4}, "cart.wheels is 4; allowed: a list of tables"),
        ({"wheels": [3]}, "cart.wheels[0] is 3; allowed: a table"),
        ({"wheels": [{}]}, "cart.wheels[0].radius_m is missing; allowed: a number from 0.1 to 2"),
        ({"axle": {"radius_m": float("nan")}}, "cart.axle.radius_m is nan; allowed: a number from 0.1 to 2"),
        (
            {"wheels": [{"radius_m": 1, "spoke_count": 2.5}]},
            "cart.wheels[0].spoke_count is 2.5; allowed: a whole number from 3",
        ),
        (
            {"wheels": [{"radius_m": 1.5, "spoke_count": 3}]},
            "cart.wheels[0].spoke_count is 3; allowed: 5 or more for a radius_m beyond 1",
        ),
        ({"wheels": [{"spokes": 1, "radius_m": 1}]},
         "cart.wheels[0].spokes is not a setting; allowed here: radius_m, spoke_count"),
        ({"loads": [1, "much"]}, "cart.loads is [1, 'much']; allowed: a list of loads"),
        ({"mass": 1}, "cart.mass is not a setting; allowed here: name, wheels, colour, loads, axle, used"),
    ],
)  # fmt: skip
def test_a_mistake_is_a_sentence_of_field_value_and_what_is_allowed(change, message):
    with pytest.raises(KeyError) as raised:
        checked({"name": "it", **change}, Cart, "cart", KeyError)
    assert raised.value.args == (message,)


def test_numbers_of_numpy_count_as_those_of_python():
    wheel = {"radius_m": np.float64(0.5), "spoke_count": np.int64(4)}
    made = checked({"name": "it", "wheels": (wheel,), "used": np.bool_(True)}, Cart)
    assert made == Cart("it", (Wheel(0.5, 4),), used=True)
    assert type(made.wheels[0].spokes) is int


def test_text_that_is_no_toml_is_refused_with_its_line():
    assert parse_toml("a.b = 1", "it") == {"a": {"b": 1}}
    with pytest.raises(KeyError, match=r"it is not TOML: .*line 2"):
        parse_toml("a = 1\nb = ?\nc = 2", "it", KeyError)
