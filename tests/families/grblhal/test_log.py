"""Settings are read out of what senders, terminals, forums and other programs make of them."""

import json
from pathlib import Path

import pytest

from amp_studio.families.grblhal.formats.log import figure, is_listing, read_log
from amp_studio.formats import import_file, is_text_of_control
from amp_studio.schema import Value

SETTINGS = {
    0: "10",
    1: "25",
    10: "511",
    11: "0.010",
    22: "1",
    100: "250.000",
    101: "250.000",
    102: "26.667",
    110: "500.000",
    120: "10.000",
    130: "-0.000",
}
LINES = [f"${number}={text}" for number, text in SETTINGS.items()]


def each(form: str) -> str:
    """Return every setting in a form: ``{s}`` is the setting, ``{n}`` its number, ``{v}`` its text,
    ``{k}`` the line.
    """
    return "\n".join(
        form.format(s=f"${n}={text}", n=n, v=text, k=k) for k, (n, text) in enumerate(SETTINGS.items(), 1)
    )


FORMS = {
    "plain": each("{s}"),
    "Windows": "\r\n".join(LINES),
    "old Macintosh": "\r".join(LINES),
    "blank lines": each("{s}\n"),
    "blanks around the sign, and a remark": (
        ">>> $$\n" + each("${n} = {v}    (Step pulse time, microseconds)") + "\nok"
    ),
    "Grbl 0.9": "Grbl 0.9j ['$' for help]\n" + each("{s} (step pulse, usec)"),
    "remark behind a semicolon": each("{s} ;Step pulse time, microseconds"),
    "remark behind //": each("{s} // Step pulse"),
    "remark behind #": each("{s} # Step pulse"),
    "remark behind a dash": each("{s} - Step pulse time"),
    "remark in words": each("{s}  Step pulse time, us"),
    "remark before": each("Step pulse time, us: {s}"),
    "answer behind the command, in one line": "$$ < " + "; ".join(LINES) + "; ok",
    "answer behind the command": "$$ < " + "\n".join(LINES) + "\nok",
    "time and arrow": each("12:34:56.789 -> {s}"),
    "time and colon": each("12:34:56.789 : {s}"),
    "time in brackets, and the command": each("[12:30:01] [ $$ ] {s} ;Step pulse time"),
    "date and time": each("2021-07-11 12:00:01,123 - INFO - {s}"),
    "date and time with zone": each("2021-07-11T12:00:01.123Z  RX {s}"),
    "time of twelve hours": each("7/11/2021 1:02:03 PM < {s}"),
    "CNCjs": (
        "CNCjs 1.10.3 [Grbl]\nConnected\nclient> $$\n" + each("{s} (x, step/mm)") + "\nok\n<Idle|MPos:0,0,0>"
    ),
    "names of directions": "Send: $$\n" + each("Recv: {s}") + "\nRecv: ok",
    "sent one by one": each("SENT: {s}\nRECV: ok"),
    "arrows": each("< {s}"),
    "stars": each("*{s}"),
    "prompt": "grbl> $$\n" + each(">>> {s}"),
    "list": each("- `{s}` - step pulse"),
    "numbered list": each("{k}. {s}"),
    "block of code": "What is wrong?\n\n```\n" + "\n".join(LINES) + "\n```\nThanks!",
    "quoted mail": each("> > {s}"),
    "line ends lost": " ".join(LINES),
    "commas in place of line ends": ", ".join(LINES),
    "web page": "<br>\n".join(LINES),
    "web page in one line": "<br>".join(LINES),
    "element": each("<setting>{s}</setting>"),
    "object": json.dumps({f"${n}": text for n, text in SETTINGS.items()}),
    "object in lines": json.dumps({f"${n}": text for n, text in SETTINGS.items()}, indent=1),
    "object for each setting": json.dumps(
        {
            "firmwareName": "Grbl 1.1f",
            "settings": [
                {"key": f"${n}", "value": text, "units": "mm", "description": f"a setting (${n})"}
                for n, text in SETTINGS.items()
            ],
        },
        indent=2,
    ),
    "object for each setting, value first, in one line": json.dumps(
        [{"value": text, "setting": f"${n}"} for n, text in SETTINGS.items()]
    ),
    "minus sign of a PDF": each("{s}").replace("=-", "=\u2212"),
    "object without quotes": "{\n" + each("  '${n}': {v},") + "\n}",
    "array": json.dumps(LINES),
    "program": each('send_line("{s}"); // step pulse'),
    "table": "Setting,Value,Description\n" + each("${n},{v},Step pulse time"),
    "table in quotes": each('"${n}","{v}","Step pulse"'),
    "table with tabs": each("${n}\t{v}\tStep pulse"),
    "table of Markdown": "| Setting | Value |\n|---|---|\n" + each("| ${n} | {v} | Step pulse, us |"),
    "table with words before the value": (
        "| $ | Name | Value | Unit |\n|---|---|---|---|\n"
        + each("| ${n} | Step (pulse) time, $1=255 too | {v} | us | Set a bit (00000ZYX). $9=1 |")
    ),
    "lines of a table without words, as a browser copies them": each("${n};Step pulse;{v};us;At least 3"),
    "two columns": each("${n} {v}"),
    "two columns, and a remark": each("${n}   {v}   step pulse, us"),
    "no sign": each("{n}={v}"),
    "names of a sender's own file": "[Controller]\n" + each("grbl_{n} = {v}"),
    "decimal commas": each("{s}").replace(".", ","),
    "table with decimal commas": each("${n};{v}").replace(".", ","),
    "colours of a terminal": each("\x1b[32m{s}\x1b[0m"),
    "no line end before ok": each("{s}ok"),
    "the first sign lost": each("{s}")[1:],
    "a remark that is a setting": each("{s}\n; $0=99\n// $0=98\n(was $0=97)"),
}


@pytest.mark.parametrize("form", FORMS)
def test_the_settings_are_read_in_every_form(form: str) -> None:
    text = FORMS[form]
    assert is_listing(text), form
    (listing,) = read_log(text).listings
    assert {number: figure(value) for number, value in listing.settings.items()} == SETTINGS, form


def test_a_text_is_kept_whole() -> None:
    log = read_log("$300=my mill, left\n$302=192.168.5.1\n$490=G4P0\n$535=02:08:dc:5f:4d:7f\n$66=\n")
    assert log.listings[0].settings == {
        300: "my mill, left",
        302: "192.168.5.1",
        490: "G4P0",
        535: "02:08:dc:5f:4d:7f",
        66: "",
    }


def test_what_a_control_answers_of_itself_is_found_in_remarks_too() -> None:
    log = read_log(
        "GrblHAL 1.1f ['$' or '$HELP' for help]\n;"
        " [BOARD:T41]\n[AXS:3:XYZ]\n[PLUGIN:A]\n[PLUGIN:B]\n[MSG:x]\n$0=5\n"
    )
    assert log.greeting.startswith("GrblHAL 1.1f")
    assert log.facts == {"BOARD": ["T41"], "AXS": ["3:XYZ"], "PLUGIN": ["A", "B"]}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "G0 X1\n",
        "hello",
        "$N0=G21",
        "$X",
        "$100 is the first",
        "I set $100=80\nand $101=80\nand it\nworks",
        "a=1\n0=5\n",
    ],
)
def test_other_texts_are_none(text: str) -> None:
    assert not is_listing(text)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("250.000", "250.000"),
        ("26,667", "26.667"),
        ("1000.", "1000."),
        ("10 usec", "10"),
        ("10us", "10"),
        ("5000mm/min (X)", "5000"),
        ("250steps/mm", "250"),
        ("5,000.000", "5000.000"),
        ("1,234,567.5", "1234567.5"),
        ("200.000ok", "200.000"),
        ("1e-05", "1e-05"),
        ("0x05", "0x05"),
        ("192.168.5.1", "192.168.5.1"),
        ("10:5", "10:5"),
        ("x80", "x80"),
    ],
)
def test_a_figure_is_the_number_at_the_beginning(text: str, expected: str) -> None:
    assert figure(text) == expected


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
def test_no_break_spaces_of_a_web_page_are_spaces(tmp_path: Path, encoding: str) -> None:
    """A browser copies them where the page has them; a listing with them was no listing at all."""
    listing = "".join(f"${n}\u00a0=\u00a0{value}\n" for n, value in ((0, 10), (1, 25), (2, 0), (110, 500)))
    path = tmp_path / "copied.txt"
    path.write_bytes(listing.encode(encoding))
    file = import_file(path)
    assert is_text_of_control(path)
    assert file.values["stepper.pulse_time", ""].value == 10


def test_the_first_setting_behind_the_tags_of_a_page_is_read() -> None:
    page = "<html><body><pre>" + "<br>\n".join(LINES) + "</pre></body></html>"
    assert read_log(page).listings[0].settings == SETTINGS
    for form in ("$ {n} = {v}", "${n}: {v}", "{n}={v}"):
        lines = [form.format(n=n, v=text) for n, text in {**SETTINGS, 302: "192.168.5.1"}.items()]
        assert read_log("\n".join(lines)).listings[0].settings == {**SETTINGS, 302: "192.168.5.1"}, form
    rows = [f"| ${n} | {text} | words |" for n, text in {**SETTINGS, 302: "192.168.5.1"}.items()]
    table = "\n".join(["| Setting | Value |", "|---|---|", *rows])
    assert read_log(table).listings[0].settings == {**SETTINGS, 302: "192.168.5.1"}


def test_the_table_of_a_web_page_is_read(tmp_path: Path) -> None:
    rows = ((0, 10), (1, 25), (2, 0), (110, 500))
    cells = "".join(f'<tr><td class="n">${n}</td><td>{v}</td><td>some words, mm</td></tr>' for n, v in rows)
    path = tmp_path / "page.html"
    path.write_text(f"<html><body><table>{cells}</table></body></html>")
    assert is_text_of_control(path)
    values = import_file(path).values
    assert (values["stepper.pulse_time", ""].value, values["axis.max_rate", "X"].value) == (10, 500)


NUMBERED = {str(n): json.loads(text.lstrip("+")) for n, text in SETTINGS.items()}
DATA = {
    "members": json.dumps(NUMBERED),
    "members on lines, in a section": json.dumps({"settings": NUMBERED}, indent=2),
    "texts": json.dumps({n: str(value) for n, value in NUMBERED.items()}),
    "objects": json.dumps([{"id": n, "value": value, "about": "x"} for n, value in NUMBERED.items()]),
    "objects with val": json.dumps([{"key": f"${n}", "val": str(v)} for n, v in NUMBERED.items()], indent=1),
    "attributes": "<?xml version='1.0'?><all>" + each('<setting id="{n}" value="{v}"/>') + "</all>",
    "elements of two": "<list>" + each("<entry><Id>${n}</Id>\n<Value>{v}</Value></entry>") + "</list>",
    "elements by number": "<list>" + each("<s{n}>{v}</s{n}>") + "</list>",
    "texts of elements": "<list>" + each('<setting no="{n}">{v}</setting>') + "</list>",
}


@pytest.mark.parametrize("form", DATA)
def test_data_of_other_programs_need_no_sign(form: str) -> None:
    assert is_listing(DATA[form])
    (found,) = read_log(DATA[form]).listings
    assert {n: float(figure(text)) for n, text in found.settings.items()} == {
        n: float(text) for n, text in SETTINGS.items()
    }
    elsewhere = DATA[form].replace("110", "711")
    assert "$" in elsewhere or not is_listing(elsewhere), "numbers that no Grbl is known by"


@pytest.mark.parametrize("head", ["[grbl]", "[grblHAL]", "[GRBL] "])
def test_numbers_below_their_own_section_are_settings_and_no_registers(tmp_path: Path, head: str) -> None:
    """Four whole numbers without a sign are a register table of another family as well."""
    path = tmp_path / "machine.ini"
    path.write_text(f"{head}\n110=500\n111=500\n112=400\n130=200\n", "utf-8")
    read = import_file(path)
    assert (read.schema.family.family, read.get(("axis.max_rate", "X"))) == (
        "grblhal",
        Value(500.0, "mm/min"),
    )
    path.write_text("[view]\n110=500\n111=500\n112=400\n130=200\n", "utf-8")
    assert not is_text_of_control(path), "numbers of any program"


def test_a_member_that_is_no_number_is_not_lost() -> None:
    (found,) = read_log(json.dumps(NUMBERED | {"32": True, "30": 1e30})).listings
    assert (found.settings[32].split(",")[0], found.settings[30].split("}")[0].strip()) == ("true", "1e+30")


@pytest.mark.parametrize("sign", ["# ", "// ", "; ", "# # ", "\t//"])
def test_settings_that_all_are_comments_are_a_listing_and_others_beside_them_are_not(sign: str) -> None:
    """Published in the source of a program, or switched off in a file of commands."""
    lines = [f"{sign}${n}={n + 0.5}\t(of the machine)" for n in (11, 100, 101, 102, 110, 111, 112, 120, 121)]
    text = "// [echo: $$]\n\n" + "\n\n".join(lines)
    assert is_listing(text)
    log = read_log(text)
    (listing,) = log.listings
    assert (listing.settings[121], len(listing.settings), log.is_comment) == ("121.5", 9, True)
    beside = read_log(f"{text}\n$100=80\n$101=80\n")
    assert (beside.listings[-1].settings, beside.is_comment) == ({100: "80", 101: "80"}, False)


def test_what_a_log_sends_behind_the_listing_is_a_change_between_reports_with_odd_stamps() -> None:
    """A sender that pads its milliseconds with blanks, and counts those since the line before."""
    log = [
        "18.11.2018 18:35:09.906 (  66) >>> $$",
        *(f"18.11.2018 18:35:10.  4 (  11) <<< {s}" for s in LINES),
    ]
    log += [
        "18.11.2018 18:35:10. 63 (  59) >>> ?",
        "18.11.2018 18:35:10. 74 (  11) <<< <Idle|MPos:0.000,0.000,0.000|FS:0,0>",
        "18.11.2018 18:35:13.107 (   5) >>> \ufffd",
        "18.11.2018 18:35:13.857 (   6) >>> $1=77",
        "18.11.2018 18:35:13.865 (   8) <<< ok",
    ]
    read = read_log("\n".join(log))
    (listing,) = read.listings
    assert listing.settings == {**SETTINGS, 1: "77"}
    assert (listing.changed, listing.aside, read.others) == ({1: ("25", "77")}, {}, [])
