"""Text formats: what controls, their tools and people read and write, as files. No link is needed for them.

``import_file`` and ``export_file`` find the format by name, by content or by the ending of the file. A format of one
family alone is in that family's folder and found by its registration.
"""

from .account import Account, NotWritten, Rounded, UnknownEntry, account_json, account_lines
from .import_export import (
    Export,
    all_formats,
    export_file,
    export_of,
    families_of,
    file_of,
    formats_of,
    import_file,
    offer_of,
)
from .text_format import FamilyNotGivenError, FormatError, ReadOptions, TextFormat, TextOffer, TextRead

__all__ = [
    "Account",
    "Export",
    "FamilyNotGivenError",
    "FormatError",
    "NotWritten",
    "ReadOptions",
    "Rounded",
    "TextFormat",
    "TextOffer",
    "TextRead",
    "UnknownEntry",
    "account_json",
    "account_lines",
    "all_formats",
    "export_file",
    "export_of",
    "families_of",
    "file_of",
    "formats_of",
    "import_file",
    "offer_of",
]
