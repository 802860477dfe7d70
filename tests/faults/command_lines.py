"""Odd command lines: each ends with a code of the contract and one line,
and refuses without having changed a file.
"""

import contextlib
import io
import json
import random
import shutil
from collections.abc import Iterator
from pathlib import Path

from amp_studio import cli
from amp_studio.files.reading import read_content
from amp_studio.files.storage import save_file
from amp_studio.formats import export_file
from amp_studio.transfer.client.kept import save_image
from amp_studio.transfer.image import encode_image

from .stored import contents
from .texts import NUMBERS, RULES, SMALL, TOKENS, mutants, violations

LINES = (
    "families --json",
    "schema 57c422b --group gains --json",
    "show 57c422b R3",
    "show 57c422b gain.integral --machine module",
    "tables 57c422b --json",
    "calculate 57c422b encoder_lines x=1",
    "new 57c422b new.amp --machine module",
    "set a.amp R3=5 --force",
    "set a.amp gain.integral@X=7 setup.encoder@X.3=yes",
    "get a.amp R3 gain.integral --all --json",
    "validate a.amp b.amp --json --why",
    "validate . --jobs 1",
    "validate a.amp --rules rules.yaml",
    "fix a.amp --param R3 --safe --dry-run --json",
    "diff a.amp b.amp --json",
    "merge a.amp b.amp c.amp -o out.amp",
    "report a.amp -o out.csv --sort axis --changed-only",
    "report a.amp -o out.txt",
    "import x.csv -o out.amp --family 57c422b --format csv --keep-unknown --on-fault keep",
    "export a.amp -o out.csv --format csv",
    "verify a.amp --with serial:/dev/none",
    "upload --from serial:/dev/none -o out.img",
    "restore a.img --to serial:/dev/none",
    "simulate a.amp step --axis X --set programmed=1 -o out.csv",
    "completion bash",
    "--version",
    "ports --json",
    "find a.amp gain integrl --json --limit 3",
    "find 57c422b overtravel",
    "get a.amp --changed --axes-differ --with-findings --json",
)
WORDS = (
    "--",
    "-",
    "-o",
    "--json",
    "--help",
    "--axes",
    "--sort",
    "a.amp",
    "rules.yaml",
    "x.csv",
    ".",
    "/dev/null",
    "/dev/full",
    "/dev/stdin",
    "folder",
    "a.amp.bak",
    ".a.amp.lock",
    "",
    " ",
    "R3=5",
    "=",
    "@X",
    "57c422b",
    "9pc",
    "../a.amp",
)


def _odd(chance: random.Random) -> list[str]:
    words = chance.choice(LINES).split()
    for _ in range(chance.choice((1, 1, 2, 3))):
        at = chance.randint(
            min(len(words), chance.random() > 0.1), len(words)
        )  # the verb is another one now and then
        match chance.randrange(5):
            case 0:
                words.insert(at, chance.choice(WORDS))
            case 1 if words:
                words.pop(at - 1)
            case 2 if words[at:]:
                words[at] = next(mutants([words[at]], chance.getrandbits(32), 1))
            case 3 if words[at:]:
                words[at] = chance.choice((*TOKENS, *NUMBERS, *WORDS))
            case _:
                words.insert(at, chance.choice(words or WORDS))
    # No program can be given a zero byte in a word; these verbs are not for a campaign in one process.
    words = [word.replace("\0", "") for word in words]
    return words if words and words[0] not in ("demo", "emulate", "__complete") else ["families"]


def fuzz_command_lines(folder: Path, seed: int, count: int) -> list[str]:
    """Run odd command lines in a folder of small files."""
    work = folder / "a" / "b" / "c" / "d" / "e" / "f"
    work.mkdir(parents=True)
    chance, found = random.Random(seed), []
    for name in ("a", "b", "c"):
        save_file(read_content(Path("x.amp"), SMALL.encode()), work / f"{name}.amp")
    (work / "rules.yaml").write_text(RULES, encoding="utf-8")
    (work / "folder").mkdir()
    small = read_content(Path("x.amp"), SMALL.encode())
    export_file(small, work / "x.csv", "csv")
    save_image(encode_image(small), work / "a.img")
    whole = contents(folder)

    def cases() -> Iterator[list[str]]:
        for _ in range(count):
            yield _odd(chance)

    def look(words: list[str]) -> None:
        out, err = io.StringIO(), io.StringIO()
        with contextlib.chdir(work), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = cli.run(words)
        message = err.getvalue()
        assert code in (0, 1, 2), f"{code}: {message}"
        assert "Traceback" not in message, message
        assert "should not have happened" not in message, message
        if code == 2 and not words[0].startswith("validate"):
            assert contents(folder) == whole, "a refusal has changed files"
            assert message.splitlines()[-1].startswith("amp-studio: "), message
            assert len(message) < 4000, message
        if code < 2 and "--json" in words and "--help" not in words and out.getvalue()[:1] == "{":
            json.loads(out.getvalue())

    for words in cases():
        found += violations(iter([words]), look, ())
        for name, content in contents(folder).items():
            if whole.get(name) != content:
                path = folder / name
                path.write_bytes(whole[name]) if name in whole else path.unlink()
        for path in work.iterdir():
            if path.is_dir() and path.name != "folder":
                shutil.rmtree(path)
    return found
