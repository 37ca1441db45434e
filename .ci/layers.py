"""Holds the modules of the simulator against the layers of ARCHITECTURE.md.

The table under the heading "Layers" names modules in backticks, the lowest layer first. A module may name
those of its own layer and of lower ones, and no modules beside each other name each other, directly or
around. What counts is every path in the code: uses and re-exports, followed to where the item is declared,
and paths in expressions and signatures. Comments, strings and tests do not count. The title page of a folder
(`mod.rs`, or `reset.rs` beside `reset/`) and its pages may name each other.

    python .ci/layers.py [ROOT]
"""

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

Name = tuple[str, ...]
"""A module or an item: the words of its path without `crate`."""

SOURCE = Path("rust/magworm/src")
PAGE = Path("ARCHITECTURE.md")

PLAIN = re.compile(
    r"""//[^\n]* | /\*.*?\*/ | r(\#*)".*?"\1 | "(?:\\.|[^"\\])*" | '(?:\\.[^']*|[^'\\])'""",
    re.VERBOSE | re.DOTALL,
)
USE = re.compile(r"\buse\s+([^;]+);")
CHILD = re.compile(r"\bmod\s+(\w+)\s*;")
DECLARED = re.compile(r"\b(?:struct|enum|union|trait|type|const|static|fn|macro_rules!)\s+(\w+)")
INLINE = re.compile(r"(?<![\w:.$])\w+(?:\s*::\s*\w+)+")


@dataclass
class Module:
    """A source file."""

    path: Path
    code: str
    children: set[str] = field(default_factory=set)
    declared: set[str] = field(default_factory=set)
    imports: dict[str, Name] = field(default_factory=dict)
    globs: list[Name] = field(default_factory=list)
    paths: list[tuple[int, Name]] = field(default_factory=list)
    """Every path in the code with the line it stands in."""


@dataclass(frozen=True, order=True)
class Naming:
    """One module names another in a line of a file."""

    path: Path
    line: int
    source: Name
    target: Name

    def __str__(self) -> str:
        """Where, and what names what."""
        return f"{self.path}:{self.line}: {show(self.source)} names {show(self.target)}"


def show(name: Name) -> str:
    """A module as code writes it."""
    return "::".join(name) or "the crate"


def blank(text: str) -> str:
    """As many lines of nothing."""
    return "\n" * text.count("\n") + " "


def code_of(text: str) -> str:
    """Source without comments, strings and tests, line for line."""
    text = PLAIN.sub(lambda match: blank(match[0]), text)
    while test := re.search(r"#\[cfg\(test\)\]\s*(?:pub\S*\s+)?(?:mod|use|fn|impl)\b[^{;]*[{;]", text):
        end = test.end()
        depth = 1 if text[end - 1] == "{" else 0
        while depth:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        text = text[: test.start()] + blank(text[test.start() : end]) + text[end:]
    return text


def branches(tree: str) -> Iterator[tuple[Name, str]]:
    """The paths of the tree of a `use`, and the name that each has from then on; `*` for a glob."""
    head, brace, rest = tree.partition("{")
    path, _, known_as = (part.strip() for part in head.partition(" as "))
    words = tuple(re.findall(r"\w+|\*", path))
    if not brace:
        yield words, known_as or words[-1]
        return
    for part in split(rest[: rest.rindex("}")]):
        for within, name in branches(part):
            whole = words if within == ("self",) else words + within
            yield whole, whole[-1] if name == "self" else name


def split(parts: str) -> Iterator[str]:
    """What stands between the commas outside braces."""
    start = depth = 0
    for place, letter in enumerate(parts + ","):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            if parts[start:place].strip():
                yield parts[start:place]
            start = place + 1


def read(path: Path, name: Name, root: Path) -> Module:
    """A file with the paths in it; those that begin with `self` or `super` are made whole."""
    code = code_of(path.read_text(encoding="utf-8"))
    module = Module(path.relative_to(root), code, set(CHILD.findall(code)), set(DECLARED.findall(code)))
    for use in USE.finditer(code):
        line = code.count("\n", 0, use.start(1)) + 1
        for words, known_as in branches(use[1].strip()):
            whole = absolute(words, name)
            module.paths.append((line, whole[:-1] if known_as == "*" else whole))
            if known_as == "*":
                module.globs.append(whole[:-1])
            else:
                module.imports[known_as] = whole
    for inline in INLINE.finditer(USE.sub(lambda use: blank(use[0]), code)):
        line = code.count("\n", 0, inline.start()) + 1
        module.paths.append((line, absolute(tuple(re.findall(r"\w+", inline[0])), name)))
    return module


def absolute(words: Name, module: Name) -> Name:
    """A path from the root of the crate; one of unknown beginning is taken from the module it stands in."""
    if words[0] == "crate":
        return words[1:]
    words = words[1:] if words[0] == "self" else words
    while words[:1] == ("super",):
        words, module = words[1:], module[:-1]
    return module + words


def modules(root: Path) -> dict[Name, Module]:
    """All files that the crate is made of."""
    found: dict[Name, Module] = {}
    waiting: list[tuple[Name, Path]] = [((), root / SOURCE / "lib.rs")]
    while waiting:
        name, path = waiting.pop()
        found[name] = module = read(path, name, root)
        folder = path.parent if path.name in ("lib.rs", "mod.rs") else path.with_suffix("")
        for child in module.children:
            places = (folder / f"{child}.rs", folder / child / "mod.rs")
            waiting += [((*name, child), place) for place in places if place.exists()]
    return found


def home(path: Name, known: dict[Name, Module], seen: frozenset[Name] = frozenset()) -> Name | None:
    """The module that declares what a path leads to; where none says so, the last on its way."""
    if path in seen:
        return None
    seen |= {path}
    module: Name = ()
    for place, word in enumerate(path):
        page = known[module]
        if word in page.children:
            module = (*module, word)
        elif word in page.imports:
            return home(page.imports[word] + path[place + 1 :], known, seen) or module
        elif word in page.declared:
            return module
        else:
            ways = [home(glob + path[place:], known, seen) for glob in page.globs]
            declared = (way for way in ways if way is not None and word in known[way].declared)
            return next(declared, module)
    return module


def namings(known: dict[Name, Module]) -> Iterator[Naming]:
    """Which module names which, but for title pages and pages of one folder."""
    for source, module in known.items():
        for line, path in module.paths:
            target = home(path, known)
            if target is None or source[: len(target)] == target or target[: len(source)] == source:
                continue
            yield Naming(module.path, line, source, target)


def layers(page: str) -> dict[Name, int]:
    """The modules of the table and their layers, counted from 0 at the lowest."""
    section = re.search(r"^## Layers\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL)
    rows = re.findall(r"^\|([^|]*)\|", section[1], re.MULTILINE) if section else []
    named = [re.findall(r"`([\w:]+)`", row) for row in rows]
    return {tuple(name.split("::")): k for k, names in enumerate(filter(None, named)) for name in names}


def layer(name: Name, table: dict[Name, int]) -> int | None:
    """The layer of a module: its own, or that of the folder it stands in."""
    return next((table[name[:k]] for k in range(len(name), 0, -1) if name[:k] in table), None)


def beside(naming: Naming) -> tuple[Name, Name]:
    """The two modules of one folder in which the one that names and the one that is named stand."""
    pairs = enumerate(zip(naming.source, naming.target, strict=False), start=1)
    depth = next(depth for depth, (one, other) in pairs if one != other)
    return naming.source[:depth], naming.target[:depth]


def circles(edges: dict[tuple[Name, Name], Naming]) -> Iterator[Naming]:
    """The namings that lie on a circle."""
    beyond: dict[Name, set[Name]] = {}
    for source, target in edges:
        beyond.setdefault(source, set()).add(target)
    for (source, target), naming in sorted(edges.items()):
        reached, waiting = {target}, [target]
        while waiting:
            fresh = beyond.get(waiting.pop(), set()) - reached
            reached |= fresh
            waiting += fresh
        if source in reached:
            yield naming


def check(root: Path) -> list[str]:
    """What breaks the layers, a line each."""
    known, table = modules(root), layers((root / PAGE).read_text(encoding="utf-8"))
    homeless = sorted(name for name in known if name and layer(name, table) is None)
    broken = [f"{PAGE}: no layer holds {show(name)}" for name in homeless]
    broken += [f"{PAGE}: there is no module {show(name)}" for name in sorted(table) if name not in known]
    edges: dict[tuple[Name, Name], Naming] = {}
    for naming in sorted(set(namings(known))):
        low, high = layer(naming.source, table), layer(naming.target, table)
        if low is not None and high is not None and low < high:
            broken.append(f"{naming}, which stands in a higher layer")
        edges.setdefault(beside(naming), naming)
    return broken + [f"{naming}, which names it back, directly or around" for naming in circles(edges)]


if __name__ == "__main__":
    broken = check(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent.parent)
    print("\n".join(broken) or "Layers hold.")
    sys.exit(bool(broken))
