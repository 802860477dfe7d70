"""Rules: a whole run, one edit, a hall full of machine files,
and the same relational rules done in other ways.
"""

import contextlib
import operator
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import count, cycle
from pathlib import Path
from random import Random
from statistics import median

from jsonschema import ValidationError
from jsonschema.validators import Draft202012Validator, extend
from measure import Measure, timed

from amp_studio.files import Change, ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import export_file, import_file
from amp_studio.schema import Address, InvalidValueError, Rule, Schema, Value, program, read_address, written
from amp_studio.schema.cel_engine import Context
from amp_studio.validate import Validator, apply_fixes
from amp_studio.validate.expression_check import ExpressionCheck
from amp_studio.validate.expression_tree import read_expression
from amp_studio.validate.expression_worth import DECIMAL, list_result, text_result
from amp_studio.validate.plan import checks_of
from amp_studio.validate.rules import RuleChecks

NUM = "num-1060-mill/MILL_1060.amp"
HALL = 5000
"""Files; a quick run takes a few that are still shared among processes."""
FEW = 12
DAMAGED = 800
"""Values of a file that are replaced by those of other parameters."""
CAM_POINTS = 1900
COSTLY = (
    "many.all(a, many.exists(b, b != a))",
    "texts.map(a, texts.map(b, a + b)) == []",
    "many.all(a, many.all(b, many.all(c, many.all(d, a >= 0.0))))",
    "size([1, 2]" + ".map(x, [x, x])" * 8 + ") > 0",
)
EDITED: Address = ("servo.excess_error", "1")
"""Many rules read it."""


def measures(folder: Path, full: Path, times: int) -> Iterator[Measure]:
    """Yield the measures of the rules; ``folder`` takes what is written."""
    num = examples_folder() / NUM
    for name, path, target in (("full 9/PC", full, 0.008), ("NUM", num, 0.005)):
        yield Measure(f"full run over a {name} file, just opened", _first_runs(path, times), target)
        validator = Validator(open_file(path).file)
        yield Measure(f"  a {name} file again", timed(validator.run, times), target)
    for name, path in (("9/PC", full), ("NUM", num)):
        yield from _edits(name, path, times)
    yield _step(times)
    yield _fixes(full, times)
    yield _cam(times)
    yield from _num_table(folder, num, times)
    yield from _peers(full, times)


def _step(times: int) -> Measure:
    """Return what a step of an expression takes, by which the cost of a rule is limited before it runs."""
    values = {"many": [1.0] * 8, "texts": ["x" * 100] * 8}
    worths = {"many": list_result(8, DECIMAL), "texts": list_result(8, text_result(100))}
    seconds: list[float] = []
    for text in COSTLY:
        check = ExpressionCheck(worths, {})
        check.result_of(read_expression(text))
        context, compiled = Context(values), program(text)
        seconds += (took / check.cost for took in timed(partial(compiled.execute, context), times))
    return Measure("step of an expression, as its cost is counted", tuple(seconds), 1e-6)


def _first_runs(path: Path, times: int) -> tuple[float, ...]:
    files = iter([open_file(path).file for _ in range(times + 1)])
    kept = []  # as a program keeps them: to throw them away is no part of the run

    def run() -> None:
        kept.append(Validator(next(files)))
        kept[-1].run()

    return timed(run, times)


def _edits(name: str, path: Path, times: int) -> Iterator[Measure]:
    """Yield what one edit costs, over every value of a file, and over the one on which most depends."""
    file = open_file(path).file
    validator = Validator(file)
    validator.run()

    def touch(address: Address) -> None:
        """Give an address another value, and its own again; both are checked."""
        value = file.values[address]
        for now in (_another(file, address, value), value):
            file.apply(Change(address, file.values[address], now))
            validator.update([address])

    touched = list(file.values) if times > 1 else list(file.values)[::20]
    every = {a: median(timed(lambda a=a: touch(a), min(times, 5))) for a in touched}
    halved = tuple([seconds / 2 for seconds in every.values()])
    yield Measure(f"re-validate after one edit of a {name} value", halved, 0.0005)
    worst = max(every, key=every.__getitem__)
    slowest = timed(lambda: touch(worst), times)
    yield Measure(f"  the slowest: {written(worst)}", tuple([seconds / 2 for seconds in slowest]))
    if EDITED in file.values:
        values = cycle([Value(12.0, "mm"), Value(11.0, "mm")])

        def edit() -> None:
            file.set(EDITED, next(values))
            validator.update([EDITED])

        yield Measure(f"  another value of {written(EDITED)}", timed(edit, 20 * times), 0.002)


def _another(file: ParameterFile, address: Address, value: Value) -> Value:
    """Return a value that a person might try instead: the next choice, the other word, a little less."""
    choices = [choice.key for choice in file.schema.parameters[address[0]].choices or ()]
    if isinstance(value.value, bool):
        return Value(not value.value)
    if isinstance(value.value, str):
        at = choices.index(value.value) + 1 if value.value in choices else 0
        return Value(choices[at % len(choices)] if choices else value.value + "x")
    return Value(value.value - 1 if isinstance(value.value, int) else value.value * 0.99, value.unit)


def _fixes(full: Path, times: int) -> Measure:
    """Return what it takes to make every fix in a file with hundreds of wrong values."""
    base, random = open_file(full).file, Random(10)
    for address in random.sample(list(base.values), DAMAGED):
        kind, unit = type(base.values[address].value), base.values[address].unit
        alike = [
            a
            for a, v in base.values.items()
            if a[1] == address[1] and type(v.value) is kind and v.unit == unit
        ]
        with contextlib.suppress(InvalidValueError):  # another parameter's choice
            base.set(address, base.values[random.choice(alike)])
    validators = []
    for _ in range(times + 2):
        validators.append(Validator(base.copy()))
        validators[-1].run()
    left = iter(validators)
    apply_fixes(next(left), lambda _: True)  # once, so that nothing is loaded while it is measured
    seconds = timed(lambda: apply_fixes(next(left), lambda _: True), times)
    return Measure("every fix of a badly damaged 9/PC file", seconds, 1.0)


def _cam(times: int) -> Measure:
    """Return what one edit costs of a point of a long cam."""
    file = open_file(examples_folder() / "57c422b-label-press/LABEL_PRESS.amp").file
    file.set(("cam.mode", "X"), Value(1))
    file.set(("cam.points", "X"), Value(CAM_POINTS))
    for n in range(CAM_POINTS):
        file.set(("cam.time_points", f"X.{n}"), Value(n % 50 * 3 - 60, "counts"))
    validator, point, numbers = Validator(file), ("cam.time_points", "X.1000"), count(100)
    validator.run()

    def edit() -> None:
        file.set(point, Value(next(numbers), "counts"))
        validator.update([point])

    return Measure(f"one edit of a cam of {CAM_POINTS} points", timed(edit, 4 * times), 0.005)


def _num_table(folder: Path, num: Path, times: int) -> Iterator[Measure]:
    """Yield what a table that came from a NUM control costs until its findings are there."""
    table = folder / "control.par"
    export_file(open_file(num).file, table)
    yield Measure(
        "import and validate a full NUM table",
        timed(lambda: Validator(import_file(table)).run(), times),
        0.020,
    )
    file = import_file(table)
    again = folder / "again.par"
    yield Measure("export a full NUM table", timed(lambda: export_file(file, again), times))
    assert again.read_bytes() == table.read_bytes()


# -- a hall full of machines ---------------------------------------------------------------------------


def measures_of_hall(folder: Path, runs: int) -> Iterator[Measure]:
    """Yield the time of the command line for a folder of machines of all families,
    of which no two are the same.
    """
    files, times = HALL if runs > 1 else FEW, max(1, runs // 5)
    hall = folder / "hall"
    hall.mkdir()
    texts = [path.read_text("utf-8") for path in sorted(examples_folder().glob("*/*.amp"))]

    def write(n: int, name: str) -> None:
        text = re.sub("(?m)^name: .*", f"name: {name}", texts[n % len(texts)], count=1)
        (hall / f"{n:04}.amp").write_text(text, "utf-8")

    for n in range(files):
        write(n, f"machine {n}")
    own = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache")}

    def validate(*options: str, of: Path = hall) -> float:
        begin = time.perf_counter()
        command = (sys.executable, "-m", "amp_studio.cli", "validate", str(of), *options)
        subprocess.run(command, capture_output=True, check=True, env=own)
        return time.perf_counter() - begin

    validate(of=examples_folder())  # compiles the facts
    for title, options, target in (
        ("on all processors", (), 15 / 5000),
        ("in one process", ("--jobs", "1"), None),
    ):
        seconds = tuple(validate("--no-cache", *options) / files for _ in range(times))
        yield Measure(f"validate {files} files from the command line {title}: a file", seconds, target)
    validate()
    seconds = tuple(validate() for _ in range(times))
    yield Measure(f"validate {files} files again, their results kept", seconds)
    changed = []
    for each in range(times):
        for n in range(0, files, max(1, files // 10)):
            write(n, f"changed {each}")
        changed.append(validate())
    yield Measure(f"validate {files} files again, ten changed", tuple(changed), 1.0)


# -- the same rules in other ways ----------------------------------------------------------------------

OPERATORS: dict[str, Callable[[float, float], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}
RELATION = re.compile(r"(\w+) (<=|>=|==|!=|<|>) (\w+)")


@dataclass(frozen=True)
class Relation:
    """One value that has to be less than another, or the like."""

    left: str
    sign: str
    right: str


def _peers(full: Path, times: int) -> Iterator[Measure]:
    """Yield the rules that compare two values: here, in Python written by hand, and in jsonschema.

    The peers are given the active values as numbers in canonical units, which is most of the work.
    """
    file = _disordered(open_file(full).file)
    rules = tuple(r for r in file.schema.rules if _is_relation(file.schema, r))
    checks = [c for c in checks_of(file.evaluation, rules) if not c.lists]
    relations = []
    for check in checks:
        left, sign, right = RELATION.fullmatch(check.rule.check).groups()
        relations.append(Relation(written(check.address_of(left)), sign, written(check.address_of(right))))
    values = {
        written(a): number
        for a in {a for check in checks for a in check.addresses}
        if (number := file.evaluation.canonical(a)) is not None
        and file.evaluation.state(a).state == "in-force"
    }

    def here(fresh: ParameterFile) -> int:
        run = RuleChecks(fresh, fresh.machine)
        return sum(1 for _ in run.findings(checks))

    by_hand, by_schema = _in_python(relations), _in_jsonschema(relations)
    broken = by_hand(values)
    assert broken == by_schema(values) == here(file) > 0
    files = iter([file.copy() for _ in range(times + 1)])
    told = f"{len(relations)} relations, {broken} broken"
    yield Measure(f"{told}: here, with states, units and messages", timed(lambda: here(next(files)), times))
    run = RuleChecks(file, file.machine)

    def again() -> None:
        run.forget_values()
        sum(1 for _ in run.findings(checks))

    yield Measure("  the same again", timed(again, times))
    yield Measure("  peer: a loop in Python over ready numbers", timed(lambda: by_hand(values), times))
    yield Measure("  peer: jsonschema with a keyword for relations", timed(lambda: by_schema(values), times))


def _is_relation(schema: Schema, rule: Rule) -> bool:
    """Return whether a rule compares two numbers, whatever else there is."""
    kinds = {schema.parameters[read_address(text)[0]].type for text in rule.reads.values()}
    return rule.when == "true" and bool(RELATION.fullmatch(rule.check)) and kinds <= {"integer", "real"}


def _disordered(file: ParameterFile) -> ParameterFile:
    """Return a file in which some relations do not hold."""
    for axis in "1234":
        file.set(("feedrate.rapid", axis), Value(1.0, "mm/min"))
    return file


def _in_python(relations: list[Relation]) -> Callable[[dict[str, float]], int]:
    compiled = [(r.left, OPERATORS[r.sign], r.right) for r in relations]

    def broken(values: dict[str, float]) -> int:
        return sum(
            left in values and right in values and not holds(values[left], values[right])
            for left, holds, right in compiled
        )

    return broken


def _in_jsonschema(relations: list[Relation]) -> Callable[[dict[str, float]], int]:
    def relation(
        _validator: object, wanted: list[str], values: dict[str, float], _schema: object
    ) -> Iterator[object]:
        left, sign, right = wanted
        if left in values and right in values and not OPERATORS[sign](values[left], values[right]):
            yield ValidationError(f"{left} {values[left]} is not {sign} {right} {values[right]}")

    kind = extend(Draft202012Validator, {"relation": relation})
    validator = kind(
        {"type": "object", "allOf": [{"relation": [r.left, r.sign, r.right]} for r in relations]}
    )
    return lambda values: sum(1 for _ in validator.iter_errors(values))
