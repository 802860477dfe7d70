"""The words of the program in the languages that it speaks: one file a language, every text under its id,
for window and documents.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .catalogue import Forms, TextSection, language_codes, name_of_language, sources_of_texts, texts_of
else:
    __getattr__ = front_page(__name__)
