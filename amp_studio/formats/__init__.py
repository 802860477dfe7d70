"""Text formats: what controls, their tools and people read and write, as files. No link is needed for them.

``import_file`` and ``export_file`` find the format by name, by content or by the ending of the file. A format
of one family alone is in that family's folder and found by its registration.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .account import Account, account_json, account_lines
    from .any_file import is_parameter_file, is_text_of_control, open_for_reading
    from .bare_figures import default_system, read_figure, system_of, write_figure
    from .import_export import (
        all_formats,
        export_file,
        export_of,
        file_of,
        formats_of,
        import_file,
        offer_of,
        text_lines,
    )
    from .passthrough_lines import (
        PassthroughLine,
        escaped,
        keep_lines,
        lines_kept,
        neighbours,
        placeholder,
        placeholder_in,
        unescaped,
    )
    from .spreadsheet_block import BlockCell, block_html, block_text, read_block, two_ways
    from .text_format import FamilyNotGivenError, FormatError, ReadOptions, TextFormat, TextOffer, TextRead
else:
    __getattr__ = front_page(__name__)
