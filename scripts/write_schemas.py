"""Writes the JSON Schemas by which an editor completes and checks fact files,
a builder's rules.yaml and project.yaml.

They come from the models that read those files, with their docstrings as descriptions, and are in
``parameter_db/schemas``, so that they travel with the package. ``make schema`` writes them;
a test sees that they are fresh.
"""

import ast
import dataclasses
import inspect
import json
from functools import cache
from pathlib import Path
from textwrap import dedent
from typing import Any

from pydantic import TypeAdapter

from amp_studio.files.project import PROJECT_FORMAT, ProjectInfo
from amp_studio.meaning.facts import Meanings
from amp_studio.schema import database_folder, family_ids, load_schema
from amp_studio.schema.model import (
    BuilderRule,
    Commissioning,
    Errata,
    FactTranslation,
    Family,
    Group,
    Guides,
    Messages,
    Model,
    MotionFacts,
    PictureRoles,
    Plausible,
    ProgramWords,
    Rules,
    Suppression,
    Synonyms,
    Tables,
    Units,
)
from amp_studio.schema.units import UNITS_FILE
from amp_studio.schema.yaml_reader import read_yaml

FOLDER = database_folder() / "schemas"
DIALECT = "http://json-schema.org/draft-07/schema#"
"""The newest one that every editor knows."""


class BuilderRules(Model):
    """A file of a builder's own rules, and of findings that a user has checked and leaves as they are."""

    rules: tuple[BuilderRule, ...] | None = None
    suppressions: tuple[Suppression, ...] | None = None


FILES: dict[str, type[Model]] = {
    "family": Family,
    "group": Group,
    "rules": Rules,
    "errata": Errata,
    "tables": Tables,
    "guides": Guides,
    "messages": Messages,
    "commissioning": Commissioning,
    "pictures": PictureRoles,
    "plausible": Plausible,
    "program": ProgramWords,
    "motion": MotionFacts,
    "translation": FactTranslation,
    "meaning": Meanings,
    "units": Units,
    "synonyms": Synonyms,
    "builder-rules": BuilderRules,
}


def schemas() -> dict[str, str]:
    """Return the text of every schema file by its name."""
    found = {name: _of_model(model) for name, model in FILES.items()} | {"project": _of_project()}
    return {
        f"{name}.schema.json": json.dumps({"$schema": DIALECT, **schema}, indent=1, ensure_ascii=False) + "\n"
        for name, schema in found.items()
    }


def _of_model(model: type[Model]) -> dict[str, Any]:
    schema: dict[str, Any] = _with_own_units(
        _in_dialect(TypeAdapter(model).json_schema(ref_template="#/definitions/{model}"))
    )
    models = {kind.__name__: kind for kind in (model, *_below(Model))}
    for name, record in {model.__name__: schema, **schema.get("definitions", {})}.items():
        described: dict[str, str] = {}
        for kind in reversed(models[name].__mro__):
            described |= _docstrings(kind)
        record["description"] = _plain(record.get("description", ""))
        for key, entry in record.get("properties", {}).items():
            entry.pop("title", None)
            if key in described:
                entry["description"] = described[key]
    return schema


def _in_dialect(schema: Any) -> Any:
    """Return a schema with the words that draft 7 has for a list of so many entries and for definitions."""
    if isinstance(schema, list):
        return [_in_dialect(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    words = {"prefixItems": "items", "$defs": "definitions"}
    return {words.get(key, key): _in_dialect(value) for key, value in schema.items()}


def _with_own_units(schema: Any) -> Any:
    """Return a schema that lists the units which only one family has behind those that every family may
    use.
    """
    every = read_yaml(UNITS_FILE.read_text(encoding="utf-8")).data["units"]
    own = {unit: None for family in family_ids() for unit in load_schema(family).family.own_units}

    def listed(part: Any) -> Any:
        if isinstance(part, dict):
            return {key: listed(value) for key, value in part.items()}
        if isinstance(part, list):
            return [*part, *own] if part == list(every) else [listed(each) for each in part]
        return part

    return listed(schema)


def _below(kind: type[Any]) -> list[type[Any]]:
    return [each for below in kind.__subclasses__() for each in (below, *_below(below))]


def _of_project() -> dict[str, Any]:
    described = _docstrings(ProjectInfo)
    properties: dict[str, Any] = {
        "amp_studio_project": {
            "type": "integer",
            "maximum": PROJECT_FORMAT,
            "description": "Format of the file.",
        }
    }
    for field in dataclasses.fields(ProjectInfo):
        if field.name != "extra":
            properties[field.name] = {"type": ["string", "number", "null"]}
            if field.name in described:
                properties[field.name]["description"] = described[field.name]
    properties["family"] = {"enum": list(family_ids()), "description": "The control family."}
    return {
        "title": "Project",
        "description": _plain(inspect.getdoc(ProjectInfo) or ""),
        "type": "object",
        "properties": properties,
        "required": ["amp_studio_project", "name", "family"],
    }


@cache
def _docstrings(kind: type[Any]) -> dict[str, str]:
    """Return what is in a text below each field of a class."""
    if kind.__module__.partition(".")[0] not in ("amp_studio", __name__):
        return {}
    body = ast.parse(dedent(inspect.getsource(kind))).body[0]
    found: dict[str, str] = {}
    if isinstance(body, ast.ClassDef):
        for field, text in zip(body.body, body.body[1:], strict=False):
            if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name):
                match text:
                    case ast.Expr(value=ast.Constant(value=str(words))):
                        found[field.target.id] = _plain(inspect.cleandoc(words))
    return found


def _plain(text: str) -> str:
    """Return a docstring as an editor shows it: a line a paragraph."""
    paragraphs = (" ".join(part.split()) for part in text.split("\n\n"))
    return "\n\n".join(paragraphs).replace("``", "`")


def main() -> None:
    """Write the files."""
    FOLDER.mkdir(exist_ok=True)
    for name, text in schemas().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
        print(FOLDER.relative_to(Path.cwd()) / name if FOLDER.is_relative_to(Path.cwd()) else FOLDER / name)


if __name__ == "__main__":
    main()
