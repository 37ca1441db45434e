"""TOML and plain values as typed tables; a mistake becomes a sentence: field, value, what is allowed."""

import re
import sys
from collections.abc import Mapping
from types import NoneType
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin

import msgspec
import numpy as np

T = TypeVar("T")
Number = Annotated[float, msgspec.Meta(ge=-1e300, le=1e300, description="a number")]
Text = Annotated[str, msgspec.Meta(min_length=1, description="a text")]


class Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A table of a document; it has no other entries than its fields.

    Where a rule between fields is broken, ``__post_init__`` raises a ValueError that begins with a field.
    """


def parse_toml(text: str, source: str, mistake: type[Exception] = ValueError) -> dict[str, Any]:
    """Parses TOML.

    Args:
        text: The TOML.
        source: What a message calls it, such as the file's name.
        mistake: What is raised where it is none; says the line.

    Raises:
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
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise mistake(f"{source} is not TOML: {error}") from error


def checked(values: object, kind: Any, where: str = "", mistake: type[Exception] = ValueError) -> Any:
    """Makes a typed table of plain values; numbers of NumPy count as Python's.

    Args:
        values: What a file or a caller gave.
        kind: What they are to be, a :class:`Table`. A ``Meta`` with a description says what a field allows.
        where: Name of the table, for the message.
        mistake: What is raised where a value is not allowed.
    """
    values = _plain(values)
    try:
        return msgspec.convert(values, kind)
    except msgspec.ValidationError as error:
        raise mistake(_sentence(str(error), values, kind, where)) from error


def _plain(value: Any) -> Any:
    """A value with the numbers of NumPy as Python's."""
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value.item() if isinstance(value, np.generic) else value


def _sentence(error: str, value: Any, hint: Any, where: str) -> str:
    """What msgspec says, such as "Expected `int` >= 1 - at `$.seeds[0]`", as a sentence of ours."""
    told, _, path = error.partition(" - at `$")
    for name, index in re.findall(r"\.(\w+)|\[(\d+)\]", path):
        if name:
            where, hint, value = f"{where}.{name}".strip("."), _fields(hint)[name], value[name]
        elif _description(hint):
            break
        else:
            where, hint, value = f"{where}[{index}]", get_args(_bare(hint))[0], value[int(index)]
    inner = where + "." if where else ""
    if missing := re.match(r"Object missing required field `(\w+)`", told):
        return f"{inner}{missing[1]} is missing; allowed: {_allowed(_fields(hint)[missing[1]])}"
    if unknown := re.match(r"Object contains unknown field `(.*)`", told):
        return f"{inner}{unknown[1]} is not a setting; allowed here: {', '.join(_fields(hint))}"
    if told.startswith(("Expected", "Invalid")):
        return f"{where} is {value!r}; allowed: {_allowed(hint)}"
    return inner + told


def _fields(hint: Any) -> dict[str, Any]:
    """Name of each entry of a table → its type."""
    return {field.encode_name: field.type for field in msgspec.structs.fields(_bare(hint))}


def _bare(hint: Any) -> Any:
    """A type without what is said about it and without None."""
    if get_origin(hint) is Annotated:
        return _bare(get_args(hint)[0])
    others = [each for each in get_args(hint) if each is not NoneType]
    return _bare(others[0]) if NoneType in get_args(hint) else hint


def _meta(hint: Any) -> msgspec.Meta | None:
    """What is said about a type."""
    if NoneType in get_args(hint):
        hint = next(each for each in get_args(hint) if each is not NoneType)
    return hint.__metadata__[0] if get_origin(hint) is Annotated else None


def _description(hint: Any) -> str | None:
    meta = _meta(hint)
    return meta.description if meta else None


def _allowed(hint: Any) -> str:
    """What a type allows, in words."""
    meta, bare = _meta(hint), _bare(hint)
    if meta is not None and meta.description:
        return meta.description
    if get_origin(bare) is Literal:
        return ", ".join(map(str, get_args(bare)))
    words = {float: "a number", int: "a whole number", str: "a text", bool: "true or false"}
    tables = any(isinstance(each, type) and issubclass(each, msgspec.Struct) for each in get_args(bare))
    words.update(dict.fromkeys([list, tuple], "a list of tables" if tables else "a list"))
    said = words.get(get_origin(bare) or bare, "a table")
    if meta is not None and meta.ge is not None:
        said += f" from {meta.ge:g}" + ("" if meta.le is None else f" to {meta.le:g}")
    return said
