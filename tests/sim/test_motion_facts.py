"""What the laws take from ``motion.yaml``: each role that is asked for is there, and each one there is
used."""

import ast
import re
from functools import cache
from pathlib import Path
from typing import get_args

import pytest

from amp_studio.scenarios import SCENARIOS
from amp_studio.schema import DatabaseError, load_schema, registration_of
from amp_studio.schema.load import compile_family
from amp_studio.schema.model.motion import MotionFacts, ScenarioName
from amp_studio.sim import ParameterRoles, law_of
from amp_studio.sim.law import simulated_families

OURS = tuple(
    family for family in simulated_families() if registration_of(family).law.startswith("amp_studio.")
)
PACKAGE = Path(__file__).parents[2] / "amp_studio"


@cache
def nodes(family: str) -> tuple[ast.AST, ...]:
    """Return the nodes of the modules of a family that read the facts of its law."""
    texts = (path.read_text("utf-8") for path in folder_of(family).rglob("*.py"))
    return tuple(node for text in texts if "law_facts" in text for node in ast.walk(ast.parse(text)))


def folder_of(family: str) -> Path:
    """Return the folder of a family's code."""
    return PACKAGE.parent.joinpath(*registration_of(family).law.partition(":")[0].split(".")[:-1])


def pattern(node: ast.expr) -> str:
    """Return the regular expression of a text that is written out, or put together in an f-string."""
    if isinstance(node, ast.Constant):
        return re.escape(str(node.value))
    if isinstance(node, ast.JoinedStr):
        return "".join(pattern(v) if isinstance(v, ast.Constant) else r"\w+" for v in node.values)
    return ""


def asked_for(family: str, of: str) -> set[str]:
    """Return what a family asks of ``ids`` or of ``MOTION``, each as a regular expression."""
    found: set[str] = set()
    for node in nodes(family):
        match node:
            case ast.Attribute(ast.Name("ids"), role) if of == "ids":
                found.add(role)
            case ast.Subscript(ast.Name("ids"), key) if of == "ids":
                found.add(pattern(key))
            case ast.Call(ast.Attribute(ast.Name("MOTION"), "value" | "reasons"), args, keywords) if (
                of == "MOTION"
            ):
                found |= {pattern(each) for each in (*args, *(k.value for k in keywords))} - {""}
    return found


@pytest.mark.parametrize("family", OURS)
def test_each_role_that_a_law_asks_for_is_a_fact_and_each_one_is_used(family: str) -> None:
    asked, known = asked_for(family, "ids"), load_schema(family).motion.params
    assert asked
    assert [each for each in asked - known.keys() if not any(re.fullmatch(each, r) for r in known)] == []
    of_any = re.compile("|".join(asked))
    assert [role for role in known if not of_any.fullmatch(role)] == []


@pytest.mark.parametrize("family", OURS)
def test_each_assumed_figure_that_a_law_asks_for_is_a_fact(family: str) -> None:
    asked, known = asked_for(family, "MOTION"), load_schema(family).motion.assumed
    assert asked
    assert [each for each in asked - known.keys() if not any(re.fullmatch(each, n) for n in known)] == []


@pytest.mark.parametrize("family", OURS)
def test_no_module_that_reads_the_facts_writes_an_id_out(family: str) -> None:
    written = {node.value for node in nodes(family) if isinstance(node, ast.Constant)}
    settings = {name for each in law_of(family).own().values() for name in each.settings}
    ids = load_schema(family).parameters.keys() - settings
    assert {each for each in written if isinstance(each, str)} & ids == set()


def test_the_scenarios_of_facts_are_those_of_the_simulator() -> None:
    assert get_args(ScenarioName) == tuple(SCENARIOS)


def test_a_law_gets_the_facts_of_its_family() -> None:
    assert law_of("syntec").motion is load_schema("syntec").motion
    assert "tap" not in law_of("syntec").motion.scenarios


def test_a_role_that_is_not_in_the_file_is_named() -> None:
    with pytest.raises(AttributeError, match=r"motion\.yaml has no parameter 'gain'"):
        ParameterRoles({"loop_gain": "servo.loop_gain"}).gain  # noqa: B018  # to read it is what fails


@pytest.mark.parametrize(
    ("motion", "line", "what"),
    [
        ("scenarios: [step]\nparams:\n  gain: servo.gain\n", 3, "there is no parameter 'servo.gain'"),
        ("scenarios: [stepp]\n", 1, "scenarios: "),
        ("scenarios: [step]\nassumed:\n  lag: {value: 1}\n", 3, "why"),
        ("scenarios: [step]\nsettings: {gain: the gain}\n", 1, "does not begin with 'model.'"),
    ],
)
def test_a_fault_in_the_facts_is_refused_with_its_line(
    tmp_path: Path, motion: str, line: int, what: str
) -> None:
    facts = Path(__file__).parents[1] / "families" / "steps" / "facts"
    for path in facts.rglob("*.yaml"):
        target = tmp_path / path.relative_to(facts)
        target.parent.mkdir(exist_ok=True, parents=True)
        target.write_bytes(path.read_bytes())
    (tmp_path / "motion.yaml").write_text(motion, "utf-8")
    with pytest.raises(DatabaseError, match=rf"motion.yaml.*{line}.*{re.escape(what)}"):
        compile_family(tmp_path)


def test_a_reason_is_that_of_the_figure_named() -> None:
    assumed = {name: {"value": 1, "why": f"Why {name}."} for name in ("delay", "lag")}
    motion = MotionFacts.model_validate({"scenarios": ["step"], "assumed": assumed})
    assert motion.reasons("delay", bandwidth="lag") == {"delay": "Why delay.", "bandwidth": "Why lag."}
    assert motion.value("lag") == 1.0
