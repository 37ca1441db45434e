"""Reading a TOML table with checked types, where every mistake names its place."""

import sys
from collections.abc import Mapping, Sequence
from typing import Any

from magworm_gym.identification.mistake import ProblemError


def parse_toml(text: str, source: str) -> dict[str, Any]:
    """Parses TOML.

    Args:
        text: The TOML.
        source: What a message calls it, such as the file's name.

    Raises:
        ProblemError: No TOML; says the line.
        ImportError: Python 3.10 without the library tomli.
    """
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        try:
            import tomli as tomllib
        except ImportError as error:
            raise ImportError(
                "TOML on Python 3.10 needs the library tomli: pip install 'magworm-gym[identify]'."
            ) from error
    try:
        return dict(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise ProblemError(f"{source} is not TOML: {error}") from error


class Table:
    """A TOML table whose entries are taken one by one.

    Args:
        entries: The table.
        where: Its place, such as ``experiment[0]``; empty for the whole file.
    """

    def __init__(self, entries: object, where: str) -> None:
        if not isinstance(entries, Mapping):
            raise ProblemError(f"{where} is {entries!r}; allowed: a table")
        self.where = where
        self._left = dict(entries)
        self._keys: list[str] = []

    def place(self, key: str) -> str:
        """Dotted name of an entry."""
        return f"{self.where}.{key}" if self.where else key

    def has(self, key: str) -> bool:
        """Whether an entry is there and has not been taken."""
        return key in self._left

    def take(self, key: str, default: Any = None) -> Any:
        """Takes an entry of any type."""
        self._keys.append(key)
        return self._left.pop(key, default)

    def refusal(self, key: str, value: object, allowed: str) -> ProblemError:
        """The error for a value that is not allowed."""
        if value is None:
            return ProblemError(f"{self.place(key)} is missing; allowed: {allowed}")
        return ProblemError(f"{self.place(key)} is {value!r}; allowed: {allowed}")

    def number(
        self, key: str, default: float | None = None, *, low: float = -1e300, high: float = 1e300
    ) -> float:
        """Takes a number within bounds; without a default it has to be there."""
        value = self.take(key, default)
        bounded = low > -1e300 or high < 1e300
        allowed = f"a number from {low:g} to {high:g}" if bounded else "a number"
        if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
            raise self.refusal(key, value, allowed)
        return float(value)

    def whole(self, key: str, default: int, *, low: int, high: int = 10**9) -> int:
        """Takes a whole number within bounds."""
        value = self.take(key, default)
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise self.refusal(key, value, f"a whole number from {low} to {high}")
        return value

    def flag(self, key: str, default: bool) -> bool:
        """Takes true or false."""
        value = self.take(key, default)
        if not isinstance(value, bool):
            raise self.refusal(key, value, "true or false")
        return value

    def text(self, key: str, default: str | None = None) -> str:
        """Takes a text that is not empty."""
        value = self.take(key, default)
        if not isinstance(value, str) or not value:
            raise self.refusal(key, value, "a text")
        return value

    def choice(self, key: str, default: str, allowed: Sequence[str]) -> str:
        """Takes one of several words."""
        value = self.take(key, default)
        if value not in allowed:
            raise self.refusal(key, value, ", ".join(allowed))
        return str(value)

    def mapping(self, key: str) -> dict[str, Any]:
        """Takes a table as it is; empty where there is none."""
        value = self.take(key, {})
        if not isinstance(value, Mapping):
            raise self.refusal(key, value, "a table")
        return dict(value)

    def tables(self, key: str) -> list["Table"]:
        """Takes a list of tables; empty where there is none."""
        value = self.take(key, [])
        if not isinstance(value, list):
            raise self.refusal(key, value, "a list of tables")
        return [Table(entry, f"{self.place(key)}[{index}]") for index, entry in enumerate(value)]

    def done(self) -> None:
        """Refuses entries that nobody took."""
        for key in self._left:
            names = ", ".join(dict.fromkeys(self._keys))
            raise ProblemError(f"{self.place(key)} is not a setting; allowed here: {names}")
