#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads which folder includes headers of which, and fails where folders go round in a circle, where a file includes a
header that is in no folder, or where docs/architecture.md does not name a folder that has headers. A room's headers that
others include, and what these include of the room, lie in the room; those for itself in its subfolder internal/. No
function or constant of an anonymous namespace has the name of one that a header of its namespace, or of one around it,
declares: the files of a library are compiled together, and it would be taken in place of that.

usage: rooms.py SOURCE_FOLDER
"""
import re
import sys
from pathlib import Path

ROOTS = ("foundation", "farmgen", "lidarsim", "estimator", "benchmarks", "library", "viewer")
INTERNAL = "internal"
NAMESPACE = re.compile(r"^namespace (plotscan[\w:]*) \{", re.MULTILINE)
FUNCTION = re.compile(r"^(?!return|using|template)[A-Za-z][\w:<>,&*\[\]. ]*?[ &*](\w+)\(", re.MULTILINE)
CONSTANT = re.compile(r"^(?:inline )?constexpr .*?\b(k[A-Z]\w*)", re.MULTILINE)
ANONYMOUS = re.compile(r"^namespace \{\n(.*?)^\}  // namespace\n", re.MULTILINE | re.DOTALL)
INCLUDE = re.compile(r'^\s*#include "([^"]+/[^"/]+)"', re.MULTILINE)


def sources(source):
    for root in ROOTS:
        for path in sorted((source / root).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield root, path


def room_of(path):
    return (path.parent.parent if path.parent.name == INTERNAL else path.parent).as_posix()


def folder_of(source, header):
    """The room that a header is included from, "estimator/methods/lattice"; nothing where it is in none."""
    return next((room_of(Path(root, header)) for root in ROOTS if (source / root / header).exists()), None)


def misplaced(source):
    """What others, or a room's open headers, include of its internal/, and open headers that neither includes."""
    wanted, open_rooms, made = set(), set(), []
    for root, path in sources(source):
        room = room_of(path.relative_to(source))
        is_open = path.suffix == ".h" and path.parent.name != INTERNAL
        for header in INCLUDE.findall(path.read_text()):
            other = folder_of(source, header)
            if other is None or (other == room and not is_open):
                continue
            wanted.add(header)
            if other != room:
                open_rooms.add(other)
            if Path(header).parent.name == INTERNAL:
                made.append(f"{path}: includes {header}, which is internal to {other}")
    for root, path in sources(source):
        header = path.relative_to(source / root)
        is_open = path.suffix == ".h" and root != "library" and header.parent.name not in ("", INTERNAL)
        if is_open and header.as_posix() not in wanted and room_of(path.relative_to(source)) in open_rooms:
            made.append(f"{path}: no other room and no open header includes it: it belongs into {INTERNAL}/")
    return made


def arrows(source):
    """Folder -> {folder that it includes: a file that does}, and what is included and is nowhere (but is made)."""
    found, lost = {}, []
    for _, path in sources(source):
        folder = room_of(path.relative_to(source))
        uses = found.setdefault(folder, {})
        for header in INCLUDE.findall(path.read_text()):
            other = folder_of(source, header)
            if other is None:
                lost.append(f"{path}: includes {header}, which is nowhere")
            elif other != folder:
                uses.setdefault(other, path)
    return found, lost


def names_in(text):
    return set(FUNCTION.findall(text)) | set(CONSTANT.findall(text))


def hidden(source):
    """Names in anonymous namespaces that a header of their namespace, or of one around it, declares too."""
    declared, texts = [], [(path, path.read_text()) for _, path in sources(source)]
    for path, text in texts:
        if path.suffix == ".h" and path.parent.name != "plotscan" and (where := NAMESPACE.search(text)):
            declared.append((where[1] + "::", names_in(text), path))
    made = []
    for path, text in texts:
        if path.suffix == ".cpp" and (where := NAMESPACE.search(text)):
            names = set().union(*map(names_in, ANONYMOUS.findall(text)))
            made += [f"{path}: {name} in an anonymous namespace hides that of {header}"
                     for around, others, header in declared if f"{where[1]}::".startswith(around)
                     for name in sorted(names & others)]
    return made


def circle(found):
    """Folders of which each includes the next and the last the first; nothing where there is no circle."""
    done, path = set(), []

    def visit(folder):
        if folder in path:
            return path[path.index(folder):] + [folder]
        if folder in done:
            return None
        path.append(folder)
        for other in found.get(folder, {}):
            if round_trip := visit(other):
                return round_trip
        done.add(path.pop())
        return None

    return next(filter(None, map(visit, found)), None)


def main(source):
    found, mistakes = arrows(source)
    mistakes += misplaced(source) + hidden(source)
    if round_trip := circle(found):
        mistakes.append("folders in a circle: " + " -> ".join(round_trip))
        mistakes += [f"  {found[a][b]} includes {b}/" for a, b in zip(round_trip, round_trip[1:])]
    page = (source / "docs/architecture.md").read_text()
    mistakes += [f"docs/architecture.md does not name {folder}" for folder in found
                 if folder not in ROOTS and folder not in page]
    print("\n".join(mistakes) or f"{len(found)} folders, no circle")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
