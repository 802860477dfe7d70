"""Real listings (figures in tests/families/grblhal/listings.yaml): import rate, round trip and false errors.
They may only get better.
"""

import tempfile
from collections.abc import Iterator
from pathlib import Path

from measure import Measure

from amp_studio.formats import FormatError, export_file, import_file
from amp_studio.schema.yaml_reader import read_yaml
from amp_studio.validate import Validator

LISTINGS = Path(__file__).parents[1] / "tests" / "families" / "grblhal" / "listings.yaml"


def measures() -> Iterator[Measure]:
    """Yield the shares of listings that are refused, of values that do not come back,
    and of errors that are none.
    """
    listings = read_yaml(LISTINGS.read_text("utf-8")).data["listings"]
    refused = values = lost = false = 0
    with tempfile.TemporaryDirectory() as folder:
        text, again = Path(folder, "listing.txt"), Path(folder, "again.settings")
        for one in listings:
            settings = dict(each.split("=", 1) for each in one["settings"].split())
            values += len(settings)
            text.write_text("".join(f"${n}={value}\n" for n, value in settings.items()), "utf-8")
            try:
                file = import_file(text)
            except FormatError:
                refused += 1
                lost += len(settings)
                continue
            false += sum(f.severity == "error" and f.rule not in one["errors"] for f in Validator(file).run())
            export_file(file, again)
            back = dict(line[1:].split("=", 1) for line in again.read_text("utf-8").splitlines())
            lost += sum(not _same(value, back.get(n, "")) for n, value in settings.items())
    yield Measure(f"{len(listings)} published listings: refused", (100 * refused / len(listings),), 5, "%")
    yield Measure("published listings: values lost or changed", (100 * lost / values,), 0.001, "%")
    yield Measure("published listings: false errors per listing", (100 * false / len(listings),), 3, "%")


def _same(text: str, back: str) -> bool:
    try:
        return float(text) == float(back)
    except ValueError:
        return text == back
