"""List the control families."""

from __future__ import annotations

from typing import Any

from amp_studio.cli.arguments import JSON
from amp_studio.cli.console import family, print_json
from amp_studio.cli.verb import Options, Verb

VERB = Verb(__doc__, JSON, examples=("amp-studio families",))


def run(options: Options) -> int:
    """List the control families."""
    from amp_studio import family_ids
    from amp_studio.report import counted

    rows: list[dict[str, Any]] = []
    for family_id in family_ids():
        schema = family(family_id)
        values = max(len(schema.on(m.key).addresses) for m in schema.family.machines)
        rows.append(
            {
                "id": family_id,
                "name": schema.family.name,
                "parameters": len(schema.parameters),
                "values": values,
                "ways": [each.model_dump() for each in schema.family.ways],
            }
        )
    if options.json:
        print_json({"families": rows})
    else:
        for row in rows:
            print(
                f"{row['id']:10} {row['name']:40} {counted(row['parameters'], 'parameter')},"
                f" {counted(row['values'], 'value')}"
            )
    return 0
