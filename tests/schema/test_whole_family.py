"""What a family must have, listed at once; all else (rules, an example, pictures, German titles, code)
may come later or never.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from new_family import write_family

from amp_studio.cli import run
from amp_studio.schema import Schema, database_folder, family_ids, load_schema
from amp_studio.schema.registration import Registration, register, unregister
from tests.guide.test_delivered import test_a_fresh_file_has_no_finding_with_axes_or_without as fresh
from tests.guide.test_steps import (
    test_every_step_has_a_separate_title_and_a_page_where_an_order_is_printed as steps,
)

CASES = Path(__file__).parents[1] / "validate"
HOW = {"what": "what it is", "find": "how a user finds its value", "wrong": "what a wrong value does"}
KINDS = {"groups": "group"}
"""Folder of a family -> the kind of its files, unless it is the name of the folder."""


def kind_of(path: Path) -> str:
    """Return which kind of facts a file of a family has: that of its folder, or its name at the top;
    the folder of a language has translations.
    """
    top = next((above for above in path.parents if (above / "family.yaml").exists()), path.parent)
    if len(path.relative_to(top).parts[0]) == 2:
        return "translation"
    is_at_top = (path.parent / "family.yaml").exists()
    return path.stem if is_at_top else KINDS.get(path.parent.name, path.parent.name)


def without_their_schema(folder: Path) -> list[str]:
    """Return the files of a family whose first line does not name the schema that an editor checks them
    by.
    """
    found = []
    for path in sorted(folder.rglob("*.yaml")):
        inside = path.relative_to(folder)
        line = (
            f"# yaml-language-server: $schema={'../' * len(inside.parts)}schemas/{kind_of(path)}.schema.json"
        )
        if path.read_text("utf-8").partition("\n")[0] != line:
            found.append(f"{inside.as_posix()}: its first line: {line}")
    return found


def missing(schema: Schema, folder: Path, listed: list[str]) -> list[str]:
    """Return what a family with its facts in ``folder`` lacks, each as what is to be written and where;
    ``listed`` are the families that editors know.
    """
    family = schema.family.family
    found = [
        f"groups/{schema.group_of[each.id].key}.yaml: {each.id}: help: {key}: {what}"
        for each in schema.parameters.values()
        if each.access != "read"
        for key, what in HOW.items()
        if not getattr(each.help, key).strip()
    ]
    if schema.rules and not (CASES / "sound_machines" / family / "machines.yaml").is_file():
        found.append(
            f"tests/validate/sound_machines/{family}/machines.yaml: a machine without findings, for the cases"
            " of its rules"
        )
    if schema.rules and not (CASES / "rule_cases" / family).is_dir():
        found.append(
            f"tests/validate/rule_cases/{family}: what breaks each of its rules, and what just does not"
        )
    found += without_their_schema(folder)
    if family not in listed:
        found.append("parameter_db/schemas: 'make schema' writes them with this family")
    return found


@pytest.mark.parametrize("family", family_ids())
def test_a_family_has_what_it_must_have(family: str) -> None:
    project = json.loads((database_folder() / "schemas/project.schema.json").read_text("utf-8"))
    found = missing(load_schema(family), database_folder() / family, project["properties"]["family"]["enum"])
    assert not found, "\n".join(found)
    assert load_schema(family).family.family == family, "the name of its folder"


def test_all_that_is_missing_is_listed_at_once(tmp_path: Path) -> None:
    write_family("bare", tmp_path)
    group = tmp_path / "bare/groups/general.yaml"
    lines = [
        line
        for line in group.read_text("utf-8").splitlines()
        if not line.startswith(("      find", "      wrong"))
    ]
    group.write_text("\n".join(lines) + "\n", encoding="utf-8")
    rules = tmp_path / "bare/rules/general.yaml"
    rules.parent.mkdir()
    rules.write_text(
        "rules:\n- {id: bare.short, title: Short, severity: warning, reads: {a: general.example}, check: a >"
        " 1.0, message: 'Example {a} is short.', page: '1'}\n",
        encoding="utf-8",
    )
    register(Registration("bare", facts=tmp_path / "bare"))
    try:
        assert missing(load_schema("bare"), tmp_path / "bare", []) == [
            "groups/general.yaml: general.example: help: find: how a user finds its value",
            "groups/general.yaml: general.example: help: wrong: what a wrong value does",
            (
                "tests/validate/sound_machines/bare/machines.yaml: a machine without findings, for the cases"
                " of its rules"
            ),
            "tests/validate/rule_cases/bare: what breaks each of its rules, and what just does not",
            (
                "rules/general.yaml: its first line: # yaml-language-server: "
                "$schema=../../schemas/rules.schema.json"
            ),
            "parameter_db/schemas: 'make schema' writes them with this family",
        ]
    finally:
        unregister("bare")


def test_the_frame_of_a_family_works_at_once(
    checkout: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = [sys.executable, str(checkout / "scripts/new_family.py"), "tiny", "--into", str(tmp_path)]
    environment = os.environ | {"PYTHONPATH": str(checkout)}
    subprocess.run(script, env=environment, check=True, capture_output=True)
    again = subprocess.run(script, env=environment, check=False, capture_output=True, text=True)
    assert again.returncode == 1
    assert "nothing was written" in again.stderr
    register(Registration("tiny", facts=tmp_path / "tiny"))
    path = tmp_path / "a.amp"
    try:
        assert missing(load_schema("tiny"), tmp_path / "tiny", ["tiny"]) == []
        fresh("tiny")
        steps("tiny")
        for arguments in (
            ["schema", "tiny"],
            ["show", "tiny", "P1"],
            ["new", "tiny", str(path)],
            ["set", str(path), "P1=5 mm", "P2=0.2 in"],
            ["validate", str(path)],
            ["report", str(path), "-o", str(tmp_path / "a.html")],
            ["guide", str(path)],
            ["find", str(path), "example"],
        ):
            assert run(arguments) == 0, capsys.readouterr().err
        assert run(["set", str(path), "P1=101 mm"]) == 2
        assert "101 mm is outside 0 to 100 mm" in capsys.readouterr().err
    finally:
        unregister("tiny")
