"""Parts of the pages that are shown as HTML: links to parameters, printed tables."""

from __future__ import annotations

import html

from amp_studio.report import Language, cells_of
from amp_studio.schema import Schema, Table
from amp_studio.ui.base.translated import worded

LINK = "param:"


def link(schema: Schema, parameter_id: str) -> str:
    """Return a link to a parameter, by its name."""
    return f'<a href="{LINK}{parameter_id}">{html.escape(schema.parameters[parameter_id].name)}</a>'


def drawn(table: Table, language: Language) -> str:
    """Return a printed table as HTML, with what decides of it in a language."""

    def own(text: str) -> str:
        return html.escape(language.facts.sentences.get(" ".join(text.split()), text))

    head, *rows = [[own(cell) for cell in row] for row in cells_of(table)]
    lines = ["<tr>" + "".join(f"<th align=left>{cell}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows]
    title = f"<h4>{own(table.title)} ({worded(f'page {table.page}')})</h4>"
    return f"{title}<table cellpadding=3>{''.join(lines)}</table><p><small>{own(table.note)}</small></p>"
