"""What the verbs ``export`` and ``import`` print of what became of each value."""

import json
from pathlib import Path

from amp_studio.files.example_files import examples


def test_the_verbs_print_the_same_in_json(amp, tmp_path: Path) -> None:
    router = next(e.path for e in examples() if e.path.stem == "ROUTER")
    done = amp("export", router, "-o", tmp_path / "z.acr", "--json")
    account = json.loads(done.out)
    assert (done.code, account["written"], len(account["not_representable"])) == (0, 43, 265)
    assert account["not_representable"][0] == {
        "param": "axes.soft_limit_plus@X",
        "value": "0.1 in",
        "why": "there is no place for it in this format (ACR command script)",
    }
    assert {**account, "not_representable": []} == {
        "written": 43,
        "kept": [],
        "not_representable": [],
        "rounded": [],
        "unknown": [],
    }
    plain = amp("export", router, "-o", tmp_path / "z.acr")
    assert "z.acr: ACR command script, 43 of 308 values" in plain.out
    assert "265 values not written, there is no place for it in this format" in plain.err
    read = amp("import", tmp_path / "z.acr", "--family", "acromill", "-o", tmp_path / "z.amp", "--json")
    assert json.loads(read.out) == {
        "written": 43,
        "kept": [],
        "not_representable": [],
        "rounded": [],
        "unknown": [],
    }
