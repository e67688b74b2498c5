"""Draw the rooms of the package and the imports between them into docs/architecture.md.

python docs/rooms.py            write the picture anew
python docs/rooms.py --check    write nothing; fail if the page shows other imports than the sources have
"""

import ast
import re
import sys
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "heartfit"
PAGE = ROOT / "docs" / "architecture.md"
BESIDE = {
    "workflow": ROOT / "workflow" / "scripts",
    "verification": ROOT / "verification",
    "benchmarks": ROOT / "benchmarks",
}
"""Folders outside of the package that import it."""
PICTURE = re.compile(r"```text\nfloor .*?```\n", re.DOTALL)
Imports = Mapping[str, set[str]]


def imported_rooms(folder: Path) -> set[str]:
    """Rooms that the sources of a folder import, in any statement of theirs."""
    names: set[str] = set()
    for file in sorted(folder.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return {name.split(".")[1] for name in names if name.startswith("heartfit.")} - {folder.name}


def read_imports() -> tuple[Imports, Imports]:
    """Imported rooms by room of the package, and by folder beside it."""
    folders = [folder for folder in sorted(PACKAGE.iterdir()) if (folder / "__init__.py").is_file()]
    rooms = {folder.name: imported_rooms(folder) for folder in folders}
    beside = {name: imported_rooms(folder) & rooms.keys() for name, folder in BESIDE.items()}
    return rooms, beside


def floor(room: str, imports: Imports) -> int:
    """Length of the longest chain of imports below a room. Raises RecursionError for a cycle."""
    return max((1 + floor(lower, imports) for lower in imports[room]), default=0)


def draw(rooms: Imports, beside: Imports) -> str:
    """The matrix of imports: a mark where the room of the row imports the room of the column."""
    order = sorted(rooms, key=lambda room: (floor(room, rooms), room))
    tens, units = zip(*(divmod(number, 10) for number in range(1, len(order) + 1)), strict=True)
    columns = ["".join(str(digit) for digit in digits) for digits in (tens, units)]
    lines = [f"floor      room          {columns[0]}", f"{'':>25}{columns[1]}"]
    for number, room in enumerate(order, 1):
        marks = _marks(rooms[room], order[: number - 1])
        lines.append(f"{floor(room, rooms):>5} {number:>3}  {room:<14}{marks}".rstrip())
    lines += [f"{'':>11}{name:<14}{_marks(lower, order)}".rstrip() for name, lower in beside.items()]
    return "```text\n" + "\n".join(lines) + "\n```\n"


def _marks(lower: set[str], columns: list[str]) -> str:
    return "".join("x" if column in lower else "." for column in columns)


def main(arguments: list[str]) -> int:
    """Carry out what the module's docstring lists."""
    old = PAGE.read_text(encoding="utf-8")
    new = PICTURE.sub(draw(*read_imports()), old)
    if arguments == ["--check"]:
        sys.stdout.write("" if old == new else "docs/architecture.md: run python docs/rooms.py\n")
        return int(old != new)
    PAGE.write_text(new, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
