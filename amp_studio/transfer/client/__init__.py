"""What puts files into controls and compares them: exchanges, the copies kept of what a control contained."""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .drift import Drift, drift_of_all, known_controls
    from .drivers import open_driver, open_driver_at, protocols_of, who_answers
    from .exchange import Outcome, look_at
    from .fleet import (
        HEADS,
        ExchangeOf,
        FleetResult,
        FleetRow,
        check_addresses,
        download_each,
        failed_row,
        verify_each,
        with_each,
    )
    from .kept import IMAGE, Copy, CopyError, digest_path, open_copy, save_image
    from .live import LiveTuning
    from .parameters import DigestError, download_file, fetch_file, fetch_image, restore_copy, sha256
    from .previous_download import NoDownloadError, last_download
    from .project_folder import FolderContent, FolderFile, folder_content
    from .record import RecordedExchange, read_exchanges, record_look
    from .status import StatusReader
    from .verification import ImageComparison, completed, verify_at, verify_content
else:
    __getattr__ = front_page(__name__)
