"""Fetch under a new name what a control contains, and print its digest."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import JSON, ON_FAULT, OUTPUT, several_controls
from amp_studio.cli.console import print_json, print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.output import check_new, write_new
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options, Verb

if TYPE_CHECKING:
    from amp_studio import MachineParameters

VERB = Verb(
    __doc__,
    *several_controls("--from", dest="source"),
    OUTPUT.but(
        help=(
            "a parameter file; or NAME.img for the image byte for byte, whatever it is; of several controls a"
            " folder"
        )
    ),
    ON_FAULT,
    JSON,
    writes=("output",),
    sections=("ADDRESS",),
    at_control=True,
    examples=(
        "amp-studio upload --from tcp://127.0.0.1:8193 -o uploaded.amp",
        "amp-studio upload --from tcp://127.0.0.1:8193 -o uploaded.img",
    ),
)


def run(options: Options) -> int:
    """Fetch what a control contains under a new name: its file, or byte for byte as an image."""
    from amp_studio import connect
    from amp_studio.cli.controls.by_hand import print_by_hand
    from amp_studio.cli.controls.fleet import check_fleet, is_fleet, record_upload, upload_several
    from amp_studio.cli.out_of_range import settle_values
    from amp_studio.files import erased_question
    from amp_studio.report import counted
    from amp_studio.transfer.client import IMAGE, digest_path, save_image

    output, source = options.output, options.source[0]
    check_fleet(options, options.source)
    if is_fleet(options, options.source):
        with stop_requested() as stop:
            from amp_studio.transfer import Exchange

            return upload_several(options, Exchange(cancel=stop))
    # Before the line is opened: an upload may be the only copy of what a control contains.
    check_new(output, "an upload")
    control = connect(source, progress=progress())
    image = control.fetch()
    if not image:
        raise UsageError("the control is empty: there is nothing to upload")
    values: int | None = None
    # The bytes first of all: they are kept even where no version of this program can read them.
    if output.suffix == IMAGE:
        save_image(image, output)
        text = f"{output}: {len(image)} bytes, digest in {digest_path(output).name}"
    else:
        machine = _readable(image, output)
        file = machine.file
        print_by_hand(file.schema.family.family)
        settle_values(file, options.on_fault, "an upload")
        write_new(machine, output)
        # A control whose battery failed contains only defaults: worth a question before the file is used.
        if question := erased_question(file):
            print_remark(f"{output}: {question}")
        values = len(file.values)
        text = f"{output}: {counted(values, 'value')}"
        record_upload(output, file, source, image)
    if options.json:
        print_json({"path": str(output), "values": values, "sha256": control.sha256})
    else:
        print(text)
        print(f"sha256 {control.sha256}")
    return 0


def _readable(image: bytes, output: Path) -> MachineParameters:
    """Return the machine of an image; raises UsageError, with how to keep the bytes, where it cannot be
    read.
    """
    from amp_studio import MachineParameters
    from amp_studio.transfer import ImageError, decode_content
    from amp_studio.transfer.client import IMAGE

    try:
        return MachineParameters(decode_content(image))
    except ImageError as error:
        raise UsageError(
            f"{error}; nothing was written (-o {output.with_suffix(IMAGE)} keeps it byte for byte)"
        ) from None
