"""How the words of a part program are read, and what its codes mean: no reader of blocks knows a family,
it knows these roles.
"""

from typing import Literal

from .record import Key, Model, Page, ParameterId

Codes = str | dict[str, str]
"""A code as it is programmed, or the one of each system (a mill, the types of a lathe)."""

CodeAction = Literal[
    "rapid",
    "line",
    "arc-cw",
    "arc-ccw",
    "cycle",
    "no-cycle",
    "level-initial",
    "level-r",
    "dwell",
    "exact-once",
    "exact",
    "slow-corners",
    "exact-path",
    "blend",
    "no-override",
    "cutting",
    "plane-xy",
    "plane-zx",
    "plane-yz",
    "centers",
    "reference",
    "reference-check",
    "reference-return",
    "reference-other",
    "work-system",
    "machine-system",
    "machine-once",
    "local-shift",
    "set-position",
    "set-data",
    "scale",
    "no-scale",
    "turn",
    "no-turn",
    "length-plus",
    "length-minus",
    "no-length",
    "subroutine",
    "modal-subroutine",
    "no-subroutine",
    "probe",
    "end",
    "zones",
    "wait-motion",
    "nothing",
]
"""What a code does to the path of a program; ``nothing`` for one that moves no axis, ``wait-motion`` for one
that waits until the moves before it have ended."""
WordRole = Literal[
    "feed",
    "move-time",
    "dwell",
    "spindle",
    "repeats",
    "peck",
    "level",
    "radius",
    "turn",
    "scale",
    "reference",
    "length-offset",
    "tool",
    "set-kind",
    "set-number",
    "blend-tolerance",
    "join-tolerance",
    "turns",
    "centers",
    "subroutine",
]
"""What a word is to a program that runs; none for one that moves no axis."""
CycleStep = Literal[
    "position",
    "rapid to R",
    "feed to the depth",
    "feed by Q",
    "rapid back by the retract distance",
    "rapid to D before the depth reached",
    "feed by Q and D",
    "again to the depth",
    "dwell P",
    "feed to R",
    "shift by Q in X",
    "rapid back",
    "to the first level in rapid with G98",
    "spindle clockwise",
    "spindle counterclockwise",
    "spindle stops at its angle",
]
"""A step of a cycle."""


class CodeSystem(Model):
    """What decides which set of codes a control has."""

    param: ParameterId
    machines: tuple[Key, ...]
    """Of these machine types the choice is the system; another machine type is a system by itself."""


class InchMetric(Model):
    """In which unit lengths are programmed after power-up."""

    param: ParameterId
    inch: tuple[Key, ...]
    page: Page


class Zeros(Model):
    """How a number without a decimal point is read."""

    leading: ParameterId
    """Yes: its digits are at the right end of the word format."""
    trailing: ParameterId
    """Yes: at the left end."""
    page: Page


class NoNumber(Model):
    """What a letter without a number is."""

    param: ParameterId
    """Yes: an error; else it counts as 0."""
    page: Page


class AxisLetters(Model):
    """The words of the axes."""

    page: Page
    format: ParameterId | None = None
    integrand: ParameterId | None = None
    """The letter of an axis for the center of an arc."""
    integrands: dict[str, str] = {}
    """Letter -> axis, where no parameter sets it."""
    integrand_params: tuple[ParameterId, ...] = ()
    incremental: ParameterId | None = None
    """The letter for a move by a distance."""
    incremental_systems: tuple[str, ...] = ()
    diameter: str = ""
    """The mode in which a word of the first axis is a diameter."""


class WordUse(Model):
    """One way to read a letter."""

    meaning: str
    page: Page
    codes: tuple[str, ...] = ()
    """With one of these codes, in the block or active; without any it is always so."""
    in_block: bool = False
    """Whether the code has to be in the block itself."""
    mode: str = ""
    """While this mode is active."""
    systems: tuple[str, ...] = ()
    format: ParameterId | None = None
    whole: bool = False
    """A number of something: no unit, no decimals."""
    bounds: tuple[float, float] | None = None
    """The least and the largest number, in its unit."""
    unit: str | dict[Literal["in", "mm"], str] = ""
    params: tuple[ParameterId, ...] = ()
    role: WordRole | None = None


class Letter(Model):
    """A letter with its uses: the first one whose conditions are true."""

    letter: str
    uses: tuple[WordUse, ...]


class ProgramCode(Model):
    """A code, or a span of codes with one meaning (``G101..G199``)."""

    code: Codes
    meaning: str
    page: Page
    mode: str = ""
    """The mode that it makes active for the words."""
    choice: Key | None = None
    """The choice of the parameter of its group that is this code after power-up."""
    params: tuple[ParameterId, ...] = ()
    refused: bool = False
    """The control knows the code and does not do it."""
    only_amp: bool = False
    """A parameter can make it active, a program cannot."""
    does: CodeAction | None = None
    """None: a program that has it is refused with its name."""
    pause: ParameterId | None = None
    """How long the axes then rest, for a code that waits for the moves before it."""
    adds: bool = False
    """Whether it leaves on what another code of its group has switched on in this way."""
    turns: bool = False
    """Whether the spindle turns from it on."""
    waits: bool = False
    """Whether switching to it waits until the moves before it have ended."""
    zones: tuple[str, ...] = ()
    """Numbers of the zones that are on from this code of ``zones`` on; those it does not name are off."""
    pairs: dict[str, str] = {}
    """Letter -> the one without which the control does not take it beside the code."""
    unpaired: str = ""
    """The code that it then shows."""
    assumed: str = ""
    """What no page prints of it, a sentence."""
    steps: tuple[CycleStep, ...] = ()
    """What a cycle does, in its order."""


class CodeGroup(Model):
    """Codes of which one is active."""

    key: str
    name: str
    page: Page
    codes: tuple[ProgramCode, ...]
    power_up: ParameterId | None = None
    systems: tuple[str, ...] = ()
    """Where only these have the group."""
    params: tuple[ParameterId, ...] = ()
    kept_at_reset: bool = False
    """A reset leaves its code as it is."""


class MacroCall(Model):
    """Codes that call a program of the builder."""

    letter: str
    page: Page
    code: ParameterId
    """Its instances are the calls; the number is that of the code."""
    none: float | None = None
    """The number that is no code."""
    call: ParameterId | None = None
    not_used: Key | None = None
    program: ParameterId | None = None
    """The program that is called; without it the instance is its number."""
    in_mdi: ParameterId | None = None


class WordCall(Model):
    """Letters whose word calls a program."""

    param: ParameterId
    """Its instances are the letters."""
    programs: dict[str, int]
    page: Page


class BackAtPowerUp(Model):
    """What brings the codes of power-up back."""

    what: str
    page: Page
    param: ParameterId | None = None
    """Yes: it does; without it, it always does."""


class ProgramLine(Model):
    """A line that is no words: a branch, or a calculation."""

    pattern: str
    """The regular expression of its beginning, in capitals."""
    meaning: str
    page: Page
    params: tuple[ParameterId, ...] = ()
    assumed: str = ""
    """What no page prints of it, a sentence."""


class PowerUpValue(Model):
    """What is active after power-up beside the codes."""

    name: str
    params: tuple[ParameterId, ...]
    page: Page


class ArcTolerance(Model):
    """How far the radius at the end of an arc may be from that at its start."""

    page: Page
    free: float
    """mm that always may be."""
    share: float
    """Share of the radius that may be besides."""
    most: float
    """mm that never may be passed."""
    least: float = 0.0
    """mm of a radius below which there is no arc."""
    reach: float = 0.0
    """mm by which half of the way between the ends of an arc by R may be longer than R."""


class ProgramPath(Model):
    """What the path of a whole program needs beside its words."""

    machines: tuple[Key, ...] = ()
    """Machine types whose programs are run; all where it is empty."""
    unknown_m: bool = False
    """Whether an M code that no page names moves no axis."""
    first: tuple[str, ...] = ()
    """Codes of groups that are active at the start where no parameter chooses one."""
    startup: ParameterId | None = None
    """A block that the control runs when it starts."""
    percent: Literal["ends", "pair", "nothing"] = "ends"
    """What a % alone in a line does that is not the first one: it ends the program, one that begins with a %
    alone, or nothing."""
    plain_text: bool = False
    """Whether the control takes a CR inside of a file for a blank, and the mark of UTF-8 for a character."""
    number_first: bool = False
    """Whether the number of a block (N) has to be its first word."""
    most_number: int = 0
    """The greatest number of a block; 0 where no source has one."""
    joined_blanks: bool = False
    """Whether a blank inside of a word is left out: ``G9 0`` is G90."""
    open_remarks: bool = False
    """Whether a remark that is not closed goes to the end of its line."""
    centers_beside: bool = False
    """Whether words of a center outside of the plane count for nothing beside one inside of it."""
    note_without_end: str = ""
    """What the control does behind the last block of a program that does not end by a code or a %, a
    sentence."""
    needs: dict[str, tuple[str, ...]] = {}
    """Letter -> codes, one of which has to be in its block or active: else the control refuses the word."""
    apart: tuple[tuple[str, ...], ...] = ()
    """Codes without a group, of which a block has one at most."""
    most_m: int = 0
    """M codes that a block has at most; 0 where no source has a number."""
    longest: int = 0
    """Characters of a block that the control reads; 0 where no source has a number."""
    plain_delete: bool = False
    """Whether the / in front of a block has no number."""
    feed_first: bool = False
    """Whether a feed in a block that changes the unit of length is read in the unit before it."""
    speed_waits: Literal["", "always", "turning"] = ""
    """When a spindle speed waits until the moves before it have ended: with each S, or with another one
    while the spindle turns."""
    shift_waits: tuple[ParameterId, int] | None = None
    """The bit of a parameter while which a change of the work coordinates waits until the moves before it
    have ended."""
    dwell_step: float = 0.0
    """s in which the control counts dwells and pauses, up to the next whole one; 0 where it has none."""
    arcs_need_words: bool = False
    """Whether a code of an arc alone in its block is refused."""
    machine_absolute: bool = False
    """Whether a move in the coordinates of the machine is refused while places are incremental."""
    arcs_by_radius: bool = False
    """Whether R may give the radius of an arc."""
    centers: ParameterId | None = None
    """The choice of how the words of an arc center are read: ``absolute``, ``incremental_positive``
    or ``incremental_negative``; without it they are distances from the start."""
    arc_tolerance: ArcTolerance | None = None
    feed: ParameterId | None = None
    """The feed where a program names none."""
    always_slow: ParameterId | None = None
    """Yes: corners are always slowed down."""
    references: tuple[ParameterId, ...] = ()
    """Positions of the reference points, of an axis each."""
    length_offsets: tuple[ParameterId, ...] = ()
    """Parts of a tool length, by the number of the offset."""
    peck_clearance: ParameterId | None = None
    """The distance D of a cycle."""
    tools_listed: str = ""
    """What is assumed of a program that calls a tool, a sentence."""
    cycles_taken_in: str = ""
    """What is assumed of a program with cycles that takes in no file, a sentence."""
    retract: ParameterId | None = None
    """How far a chip-breaking cycle goes back; without it no page prints it."""
    variables: tuple[ParameterId, ...] = ()
    """Program parameters that the control keeps; an instance is the number of one."""
    offset_variables: tuple[tuple[int, int], ...] = ()
    """Program parameters, from and to, that are offsets or positions of the control."""
    probed: tuple[int, int] | None = None
    """Program parameters that get the positions at the contact of a probe."""
    depth: int = 0
    """How deep subroutines may call each other; 0 without them."""
    assumed: tuple[str, ...] = ()
    """What no page prints of it, each a sentence."""
    faults: dict[str, str] = {}
    """What is wrong -> the code that the control shows."""


class ProgramWords(Model):
    """A file ``program.yaml``: words and codes of a family's part programs."""

    page: Page | None = None
    not_printed: str = ""
    """What no source here prints of its programs."""
    system: CodeSystem | None = None
    units: InchMetric | None = None
    zeros: Zeros | None = None
    no_number: NoNumber | None = None
    expressions: bool = False
    """A word may have an expression in parentheses for its number."""
    axes: AxisLetters | None = None
    letters: tuple[Letter, ...] = ()
    groups: tuple[CodeGroup, ...] = ()
    codes: tuple[ProgramCode, ...] = ()
    """Codes for one block, or that belong to no group."""
    calls: tuple[MacroCall, ...] = ()
    word_calls: WordCall | None = None
    backs: tuple[BackAtPowerUp, ...] = ()
    values: tuple[PowerUpValue, ...] = ()
    statements: tuple[ProgramLine, ...] = ()
    variables: dict[str, int] = {}
    """Letter of a call with values -> program parameter that gets its number."""
    path: ProgramPath | None = None
    """None where no path can be worked out."""
