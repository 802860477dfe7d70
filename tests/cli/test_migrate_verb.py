"""migrate: what is written under which name."""

from pathlib import Path

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


def test_a_name_of_a_parameter_file_is_one_that_every_verb_takes(amp, tmp_path: Path) -> None:
    """It was the listing of the new control under that name, which no verb could read."""
    path = tmp_path / "new.amp"
    message = amp("migrate", MILL, "--to", "grblhal", "-o", path, "--draft")
    assert message.code == 0
    assert "HAL is a template" not in message.out
    values = {row["param"]: row["value"] for row in amp("get", path, "$110", "$130", "--json").json["values"]}
    assert values == {"$110": 10000.0, "$130": 506.0}
    assert amp("migrate", MILL, "--to", "grblhal", "-o", path, "--draft").code == 2
