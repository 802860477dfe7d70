"""Read the C sources of grblHAL and its plugins: the settings, their numbers and their texts."""

import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

AXIS_UNITS = {
    "axis_steps": "step/mm",
    "axis_rate": "mm/min",
    "axis_accel": "mm/sec^2",
    "axis_dist": "mm",
    "axis_jerk": "mm/sec^3",
}
RUN_TIME = {
    "netservices": "Telnet,Websocket,HTTP,FTP,DNS,mDNS,SSDP,WebDAV",  # networking.c service_names
    "PWM_SPINDLE_NO_DELAYS": ",Disable delays",
}
"""Labels that the firmware puts together while it runs."""
GROUP_NAMES = {
    "Group_UserSettings": "User settings",
    "Group_AuxPorts": "Aux ports",
    "Group_ModBusUnit0": "ModBus TCP",
    "Group_Encoder0": "Encoders",
    "Group_Kinematics": "Kinematics",
    "Group_Networking": "Networking",
    "Group_Networking_Wifi": "WiFi",
}


@dataclass
class Found:
    """One setting as one source describes it."""

    number: int
    constant: str
    group: str
    name: str
    unit: str
    form: str
    labels: str
    least: str
    most: str
    options: str
    source: str
    """Repository and file."""
    line: int
    condition: str
    count: int = 1
    """How many there are, ``step`` numbers apart."""
    step: int = 1

    @property
    def is_of_axes(self) -> bool:
        return self.group == "Group_Axis0"


@dataclass
class Sources:
    """All that was read."""

    numbers: dict[str, int] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    groups: dict[str, str] = field(default_factory=lambda: dict(GROUP_NAMES))
    settings: list[Found] = field(default_factory=list)


def files_of(folder: Path) -> Iterator[tuple[str, str]]:
    """Yield name and text of every C source of a checkout or a git directory."""
    if (folder / "HEAD").exists() or (folder / "objects").exists():
        git = ["git", f"--git-dir={folder}"]
        names = subprocess.run(
            [*git, "ls-tree", "-r", "--name-only", "HEAD"], capture_output=True, text=True, check=True
        )
        for name in names.stdout.splitlines():
            if name.endswith((".c", ".h")):
                shown = subprocess.run([*git, "show", f"HEAD:{name}"], capture_output=True, check=True)
                yield name, shown.stdout.decode("utf-8", "replace")
        return
    for path in sorted((*folder.rglob("*.c"), *folder.rglob("*.h"))):
        yield str(path.relative_to(folder)), path.read_text("utf-8", "replace")


def without_comments(text: str) -> str:
    """Return C without remarks, with the same lines."""
    text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m[0].count("\n"), text, flags=re.DOTALL)
    return re.sub(r'("(?:[^"\\\n]|\\.)*")|//[^\n]*', lambda m: m[1] or "", text)


def read_numbers(text: str, numbers: dict[str, int]) -> None:
    """Take the numbers of enumerations and definitions that name settings."""
    for body in re.findall(r"enum\s*\w*\s*\{(.*?)\}", text, re.DOTALL):
        last = -1
        for entry in body.split(","):
            found = re.search(
                r"(?m)^\s*(\w+)\s*(?:=\s*([^\n]+))?\s*$", re.sub(r"(?m)^\s*#.*$", "", entry).strip()
            )
            if found is None:
                continue
            value = worth(found[2], numbers) if found[2] else last + 1
            if value is None:
                continue
            numbers.setdefault(found[1], value)
            last = value
    for name, body in re.findall(
        r"(?m)^[ \t]*#\s*define\s+(\w+)[ \t]+(\(?\w+(?:\s*[+*]\s*\w+)*\)?)[ \t]*$", text
    ):
        value = worth(body, numbers)
        if value is not None:
            numbers.setdefault(name, value)


def worth(text: str, numbers: dict[str, int]) -> int | None:
    """Return what a sum of names and numbers is worth; None where a name is not known."""
    total = 0
    for part in text.strip("() ").split("+"):
        product = 1
        for factor in part.strip("() ").split("*"):
            name = factor.strip("() ")
            value = int(name) if name.isdecimal() else numbers.get(name)
            if value is None:
                return None
            product *= value
        total += product
    return total


def read_texts(text: str, texts: dict[str, str]) -> None:
    """Take the texts that variables have; the longest where a name has several."""
    named = r"(?:char\s+(?:const\s*)?\*?\s*(\w+)\s*(?:\[\w*\])?\s*=|#\s*define\s+(\w+))"
    pattern = named + r"\s*((?:\"(?:[^\"\\\n]|\\.)*\"\s*)+)"
    for variable, macro, quoted in re.findall(pattern, text):
        name, value = variable or macro, "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', quoted))
        if len(value) > len(texts.get(name, "")):
            texts[name] = value


def conditions(lines: list[str]) -> list[str]:
    """Return for each line under which conditions of the preprocessor it is compiled."""
    found: list[str] = []
    stack: list[str] = []
    for line in lines:
        part = re.match(r"\s*#\s*(if|ifdef|ifndef|elif|else|endif)\b\s*(.*)", line)
        if part:
            word, rest = part[1], " ".join(part[2].split())
            if word == "endif" and stack:
                stack.pop()
            elif word == "elif" and stack:
                stack[-1] = rest
            elif word == "else" and stack:
                stack[-1] = f"!({stack[-1]})"
            elif word not in ("endif", "elif", "else"):
                stack.append({"ifdef": f"defined({rest})", "ifndef": f"!defined({rest})"}.get(word, rest))
        found.append(
            " && ".join(stack[1:] if stack and stack[0].startswith(("!defined(_", "defined(_")) else stack)
        )
    return found


def read_settings(name: str, text: str, sources: Sources) -> None:
    """Take the settings that a file describes."""
    lines = text.split("\n")
    under = conditions(lines)
    for table in re.finditer(r"setting_detail_t\s+\w+\s*\[\s*\]\s*=\s*\{", text):
        end = text.index("\n};", table.end()) if "\n};" in text[table.end() :] else len(text)
        for entry in re.finditer(
            r"(?m)^\s*\{\s*((?:Settings?_|TMC)\w+(?:\s*\+\s*\w+)?)\s*,(.*)$", text[table.end() : end]
        ):
            line = text.count("\n", 0, table.end() + entry.start(1)) + 1
            cells = [cell.strip() for cell in split(entry[2])]
            number = worth(entry[1], sources.numbers)
            if number is None or len(cells) < 7 or re.search("GANGED|UserDefined", entry[1]):
                # an axis of two motors; a number that means something else in each plugin
                continue
            group, title, unit, form, labels, least, most = cells[:7]
            sources.settings.append(
                Found(
                    number,
                    entry[1],
                    group.split("+")[0].strip(),
                    resolved(title, sources),
                    resolved(AXIS_UNITS.get(unit, unit), sources),
                    form,
                    resolved(labels, sources),
                    resolved(least, sources),
                    resolved(most, sources),
                    ",".join(cells[7:]),
                    name,
                    line,
                    under[line - 1],
                )
            )


def split(text: str) -> list[str]:
    """Return the cells between commas that are in no quotes or braces."""
    cells: list[str] = []
    depth, quoted, start = 0, False, 0
    for n, sign in enumerate(text):
        if sign == '"' and text[n - 1] != "\\":
            quoted = not quoted
        elif not quoted and sign in "{(":
            depth += 1
        elif not quoted and sign in "})":
            depth -= 1
            if depth < 0:
                return [*cells, text[start:n]]
        elif not quoted and sign == "," and depth == 0:
            cells.append(text[start:n])
            start = n + 1
    return [*cells, text[start:]]


def resolved(cell: str, sources: Sources) -> str:
    """Return the text of a cell: what is in quotes, and the texts of its names."""
    if cell == "NULL":
        return ""
    found = []
    for quoted, name in re.findall(r'"((?:[^"\\]|\\.)*)"|(\w+(?:\[\w+\])?(?:\.\w+)*)', cell):
        found.append(
            quoted
            or RUN_TIME.get(name, sources.texts.get(name, f"<{name}>" if '"' not in cell or name else ""))
        )
    return "".join(found)
