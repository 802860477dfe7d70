"""Text formats: what controls, their tools and people read and write, as files. No link is needed for them.

``import_file`` and ``export_file`` find the format by name, by content or by the ending of the file. A format of one
family alone is in that family's folder and found by its registration.
"""

from .import_export import (
    all_formats,
    export_file,
    families_of,
    file_of,
    formats_of,
    import_file,
    offer_of,
)
from .text_format import FamilyNotGivenError, FormatError, ReadOptions, TextFormat, TextOffer, TextRead

__all__ = [
    "FamilyNotGivenError",
    "FormatError",
    "ReadOptions",
    "TextFormat",
    "TextOffer",
    "TextRead",
    "all_formats",
    "export_file",
    "families_of",
    "file_of",
    "formats_of",
    "import_file",
    "offer_of",
]
