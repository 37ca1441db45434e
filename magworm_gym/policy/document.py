"""Tables of a JSON document, whose entries are asked for by name and kind."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from magworm_gym.arguments import shown
from magworm_gym.policy.mistake import PolicyError

Kind = TypeVar("Kind")
MISSING = object()
KINDS = {str: "text", bool: "true or false", list: "a list", dict: "a table"}


class Table:
    """One table of a document.

    Args:
        where: The file, and within it the names that lead to the table.
        content: What stands there.
    """

    def __init__(self, where: str, content: dict[str, Any]) -> None:
        self._where = where
        self._content = content

    @classmethod
    def of_file(cls, path: Path) -> Table:
        """The table that a file holds. Raises PolicyError."""
        try:
            content = json.loads(path.read_text("utf-8"), parse_constant=_refuse)
        except OSError as error:
            raise PolicyError(f"{path} cannot be read: {error.strerror}") from None
        except (ValueError, RecursionError) as error:
            raise PolicyError(f"{path} is not JSON: {str(error) or 'nested too deep'}") from None
        return cls("", {str(path): content}).table(str(path))

    def entry(self, name: str, kind: type[Kind]) -> Kind:
        """An entry of exactly that kind. Raises PolicyError."""
        value = self._content.get(name, MISSING)
        if type(value) is not kind:
            self._refuse(name, value, KINDS[kind])
        return value

    def number(self, name: str, null: float | None = None) -> float:
        """A finite number; JSON's null stands for ``null`` where that is given. Raises PolicyError."""
        value = self._content.get(name, MISSING)
        return null if value is None and null is not None else self._number(name, value)

    def size(self, name: str) -> int:
        """A whole number from 1 on. Raises PolicyError."""
        value = self._content.get(name, MISSING)
        if type(value) is not int or value < 1:
            self._refuse(name, value, "a whole number from 1 on")
        return value

    def numbers(self, name: str) -> list[float]:
        """A list of finite numbers. Raises PolicyError."""
        return [self._number(f"{name}[{i}]", value) for i, value in enumerate(self.entry(name, list))]

    def table(self, name: str) -> Table:
        """A table in this one. Raises PolicyError."""
        return Table(self._path(name), self.entry(name, dict))

    def tables(self, name: str) -> list[Table]:
        """A list of tables. Raises PolicyError."""
        entries = {f"{name}[{i}]": value for i, value in enumerate(self.entry(name, list))}
        listed = Table(self._where, entries)
        return [listed.table(entry) for entry in entries]

    def each_number(self) -> dict[str, float]:
        """The table's entries, which are finite numbers. Raises PolicyError."""
        return {name: self.number(name) for name in self._content}

    def plain(self) -> dict[str, Any]:
        """The table as it is."""
        return self._content

    def _number(self, name: str, value: Any) -> float:
        number = value if type(value) in (int, float) else math.nan
        try:
            if math.isfinite(number):
                return float(number)
        except OverflowError:  # a whole number beyond every float
            pass
        self._refuse(name, value, "a finite number")

    def _path(self, name: str) -> str:
        return (
            f"{self._where}: {name}" if self._where.endswith(".json") else f"{self._where}.{name}".strip(".")
        )

    def _refuse(self, name: str, value: Any, allowed: str) -> NoReturn:
        given = "missing" if value is MISSING else shown(value)
        raise PolicyError(f"{self._path(name)} is {given}; allowed: {allowed}")


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no number")
