"""The machine of the motion window out of a record of the drive, or out of the file that one was written
to.
"""

from math import copysign, cos, sin
from pathlib import Path

import pytest
from PySide6.QtWidgets import QComboBox, QDialog, QFileDialog, QFormLayout, QLineEdit
from pytestqt.qtbot import QtBot

from amp_studio.files import open_file
from amp_studio.sim import SimulationError, read_machine
from amp_studio.ui.motion.identify_dialog import IdentifyDialog
from amp_studio.ui.motion.machine_page import MachinePage
from tests.sim.test_frequency_response import FREQUENCIES, hidden_plant, table

from .alt_letters import doubled, texts_of

FILE = open_file(Path(__file__).parents[2] / "examples/mill-1394/MILL_1394.amp").file


@pytest.fixture
def record(tmp_path: Path) -> Path:
    """Return a record in amperes, of an axis that swings: 50 mm/s² for 1 A, 2 A of dry friction."""
    rows = ((n / 50, 80.0 * sin(0.12 * n), 9.6 * cos(0.12 * n)) for n in range(300))
    lines = (f"{t},{v:.3f},{i + 0.03 * v + copysign(2.0, v):.3f}\n" for t, v, i in rows)
    path = tmp_path / "drive.csv"
    path.write_text("time (s),velocity (mm/s),current (A)\n" + "".join(lines))
    return path


@pytest.fixture
def dialog(qtbot: QtBot, record: Path) -> IdentifyDialog:
    displayed = IdentifyDialog(FILE, "1", record)
    qtbot.addWidget(displayed)
    return displayed


def type_scale(dialog: IdentifyDialog, text: str) -> None:
    scale = dialog.form.editor("scale", QLineEdit)
    scale.setText(text)
    scale.editingFinished.emit()


def figures_of(dialog: IdentifyDialog) -> dict[str, str]:
    """Return the rows of figures."""
    rows = {}
    for n in range(dialog.figures.rowCount()):
        name, text = (dialog.figures.itemAt(n, role) for role in _ROLES)
        assert name is not None
        assert text is not None
        rows[name.widget().text()] = text.widget().text()
    return rows


_ROLES = (QFormLayout.ItemRole.LabelRole, QFormLayout.ItemRole.FieldRole)


def test_a_frequency_response_gives_its_resonance_and_the_notch_for_it(qtbot: QtBot, tmp_path: Path) -> None:
    figures, response, _ = hidden_plant(2)
    path = tmp_path / "frf.csv"
    path.write_text(table(FREQUENCIES[::2], response[::2]))
    dialog = IdentifyDialog(FILE, "1", path)
    qtbot.addWidget(dialog)
    assert dialog.trace is not None
    assert dialog.trace.result["resonance"][0] == pytest.approx(figures["resonance"], rel=0.03)
    assert {"resonance", "delay"} <= set(figures_of(dialog))
    assert "notch" in dialog.message.text()
    assert dialog.form.editors["chirp"].isHidden()
    assert dialog.use.isEnabled()
    assert doubled(texts_of(dialog)) == {}
    motion = dialog.form.editor("motion", QComboBox)
    motion.setCurrentIndex(motion.findData("velocity"))
    assert "The response is not that of inertia" in dialog.message.text()
    motion.setCurrentIndex(motion.findData("position"))
    assert "the position of the motor" in dialog.trace.model


def test_amperes_need_a_scale_and_then_the_fit_is_shown(dialog: IdentifyDialog) -> None:
    assert "give how much is 1 %" in dialog.message.text()
    assert not dialog.use.isEnabled()
    type_scale(dialog, "0,5 A")
    assert dialog.trace is not None
    assert dialog.trace.result["coulomb_friction"][0] == pytest.approx(4.0, rel=0.02)
    assert dialog.use.isEnabled()
    assert dialog.plot.picture is not None
    assert {"Coulomb friction", "r²", "Rows"} <= set(figures_of(dialog))
    type_scale(dialog, "much")
    assert dialog.trace is None
    assert dialog.plot.picture is None
    assert doubled(texts_of(dialog)) == {}


def test_the_machine_is_saved_and_opened_again(
    dialog: IdentifyDialog, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    type_scale(dialog, "0.5 A")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "x"), ""))
    dialog.save.click()
    assert read_machine(tmp_path / "x.yaml").axis == "X"
    runs: list[str] = []
    failed: list[Exception] = []
    page = MachinePage(lambda *_: runs.append("run"), lambda: (FILE, "1"), failed.append)
    qtbot.addWidget(page)
    page.form.offer_settings(
        {
            f"model.{name}": name
            for name in ("acceleration_per_output", "viscous_friction", "coulomb_friction", "gravity")
        },
        ("", ""),
    )
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(tmp_path / "x.yaml"), ""))
    page.open.click()
    field = page.form.editors["model.coulomb_friction"]
    assert isinstance(field, QLineEdit)
    assert float(field.text()) == pytest.approx(4.0, rel=0.02)
    assert runs == ["run"]
    (tmp_path / "x.yaml").write_text("model: 5")
    page.open.click()
    assert [type(error) for error in failed] == [SimulationError]


def test_the_figures_of_a_record_fill_the_fields_when_they_are_accepted(
    record: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    record.write_text(record.read_text().replace("current (A)", "torque (%)"))
    runs: list[str] = []
    page = MachinePage(
        lambda *_: runs.append("run"), lambda: (FILE, "1"), lambda error: pytest.fail(str(error))
    )
    qtbot.addWidget(page)
    page.form.offer_settings(
        {
            f"model.{name}": name
            for name in ("acceleration_per_output", "viscous_friction", "coulomb_friction", "gravity")
        },
        ("", ""),
    )
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(record), ""))
    monkeypatch.setattr(IdentifyDialog, "exec", lambda self: QDialog.DialogCode.Rejected)
    page.record.click()
    assert not runs
    monkeypatch.setattr(IdentifyDialog, "exec", lambda self: QDialog.DialogCode.Accepted)
    page.record.click()
    assert runs == ["run"]
    assert page.form.filled_in()["model.acceleration_per_output"].endswith(" mm/s2")
    page.leave_axis("1")
    assert len(page.form.filled_in()) == 4
    field = page.form.editors["model.gravity"]
    assert isinstance(field, QLineEdit)
    field.setText("7")
    page.leave_axis("2")
    assert page.form.filled_in() == {"model.gravity": "7"}, "what somebody has typed stays"
