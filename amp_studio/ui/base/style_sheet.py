"""The style sheet over Fusion and the palette: flat buttons and fields, tabs, segments, chips, bars.

The views of the window have no rule here: their delegates paint, which is quicker.
Lists have one, of their height.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from string import Template

_MARKS = Path(__file__).parents[1] / "marks"
"""Check marks and arrows: a style sheet can draw them only from files."""

_SHEET = Template("""
QToolTip { background: $raised; color: $text; border: 1px solid $line2; padding: 4px 8px; }
QMenuBar { background: $window; spacing: 0; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected, QMenuBar::item:pressed { background: $hover; }
QMenu { background: $raised; border: 1px solid $line2; padding: 4px; }
QMenu::item { padding: 4px 28px 4px 10px; border-radius: 4px; }
QMenu::item:selected { background: $selbg; }
QMenu::item:disabled { color: $off; background: transparent; }
QMenu::icon { left: 6px; }
QMenu::separator { height: 1px; background: $line; margin: 4px 6px; }
QStatusBar { background: $window; border-top: 1px solid $line; }
QStatusBar::item { border: 0; }
QToolBar { background: $window; border: 0; border-bottom: 1px solid $line; spacing: 2px; padding: 3px 8px; }
QToolBar::separator { width: 1px; background: $line2; margin: 6px 6px; }
QMainWindow::separator { background: $line; width: 1px; height: 1px; }
QSplitter::handle { background: $line; }
QSplitter::handle:horizontal { width: 1px; }
QSplitter::handle:vertical { height: 1px; }

QPushButton { background: $raised; color: $text; border: 1px solid $line2; border-radius: 4px;
    padding: 3px 10px; min-height: 18px; }
QPushButton:hover { background: $hover; }
QPushButton:pressed { background: $selidle; }
QPushButton:focus { border-color: $sel; }
QPushButton:disabled { color: $off; border-color: $line; }
QPushButton[primary="true"], QDialog QPushButton:default { background: $sel; color: $onsel;
    border-color: $sel; }
QPushButton[primary="true"]:focus, QDialog QPushButton:default:focus { border-color: $text; }
QPushButton[primary="true"]:disabled, QDialog QPushButton:default:disabled { background: $selidle;
    color: $dim; border-color: $line2; }

QToolButton { border: 1px solid transparent; border-radius: 4px; padding: 3px 5px; background: transparent;
    color: $text; }
QToolButton:hover { background: $hover; }
QToolButton:pressed { background: $selidle; }
QToolButton:focus { border-color: $sel; }
QToolButton:disabled { color: $off; }
QToolButton:checked { background: $selbg; }
QToolButton[popupMode="1"] { padding-right: 14px; }
QToolButton::menu-indicator { image: none; }
QToolButton[segment="first"], QToolButton[segment="middle"], QToolButton[segment="last"],
QToolButton[segment="only"] {
  background: $raised; border: 1px solid $line2; border-radius: 0; padding: 3px 9px; }
QToolButton[segment="first"] { border-top-left-radius: 4px; border-bottom-left-radius: 4px; }
QToolButton[segment="middle"], QToolButton[segment="last"] { border-left: 0; }
QToolButton[segment="last"] { border-top-right-radius: 4px; border-bottom-right-radius: 4px; }
QToolButton[segment="only"] { border-radius: 4px; }
QToolButton[segment][tight="true"] { padding: 3px 2px; }
QToolButton[segment]:hover { background: $hover; }
QToolButton[segment]:checked { background: $selbg; }
QToolButton[segment]:focus { border-color: $sel; }
QToolButton[chip="true"] { background: transparent; border: 1px solid $line2; border-radius: 10px;
    padding: 1px 6px; }
QToolButton[chip="true"]::menu-indicator { image: none; width: 0; }
QToolButton[chip="true"]:hover { background: $hover; }
QToolButton[chip="true"]:checked { background: $selidle; border-color: $selidle; }
QToolButton[chip="true"]:focus { border-color: $sel; }

QLineEdit, QPlainTextEdit, QAbstractSpinBox, QComboBox { background: $base; color: $text;
    border: 1px solid $edge; border-radius: 4px; padding: 2px 6px;
  selection-background-color: $sel; selection-color: $onsel; }
QLineEdit, QAbstractSpinBox, QComboBox { min-height: 20px; }
QLineEdit:focus, QPlainTextEdit:focus, QAbstractSpinBox:focus, QComboBox:focus { border: 1px solid $sel; }
QLineEdit:disabled, QPlainTextEdit:disabled, QAbstractSpinBox:disabled, QComboBox:disabled { color: $off;
    border-color: $line2; }
QComboBox::drop-down, QAbstractSpinBox::up-button, QAbstractSpinBox::down-button { border: 0;
    background: transparent; width: 18px; }
QComboBox::down-arrow, QAbstractSpinBox::down-arrow { image: url("$marks/down-$scheme.svg"); width: 12px;
    height: 12px; }
QAbstractSpinBox::up-arrow { image: url("$marks/up-$scheme.svg"); width: 12px; height: 12px; }
QCheckBox::indicator, QRadioButton::indicator, QAbstractItemView::indicator { width: 13px; height: 13px;
    border: 1px solid $edge; border-radius: 3px; background: $base; }
QRadioButton::indicator { border-radius: 7px; }
QCheckBox::indicator:checked, QRadioButton::indicator:checked, QAbstractItemView::indicator:checked,
QCheckBox::indicator:indeterminate, QAbstractItemView::indicator:indeterminate { background: $sel;
    border-color: $sel; }
QCheckBox::indicator:checked, QAbstractItemView::indicator:checked { image: url("$marks/check-$scheme.svg"); }
QCheckBox::indicator:indeterminate, QAbstractItemView::indicator:indeterminate {
    image: url("$marks/dash-$scheme.svg"); }
QRadioButton::indicator:checked { image: url("$marks/dot-$scheme.svg"); }
QCheckBox::indicator:focus, QRadioButton::indicator:focus { border-color: $sel; }
QCheckBox::indicator:disabled, QRadioButton::indicator:disabled { border-color: $line2; background: $window; }
QAbstractItemView QLineEdit, QAbstractItemView QComboBox { min-height: 0; border-radius: 0; padding: 0 4px;
    border: 2px solid $sel; }

QFrame#find-popup { background: $raised; border: 1px solid $line2; border-radius: 4px; }
QFrame#find-popup QListView { background: $raised; }
QFrame#find-popup QLabel { color: $dim; border-top: 1px solid $line; }

QTabWidget::pane { border: 0; border-top: 1px solid $line; }
QTabBar { background: $window; }
QTabBar::tab { background: $window; color: $dim; border: 0; border-right: 1px solid $line;
    border-top: 2px solid transparent; padding: 5px 12px 6px 12px; }
QTabBar::tab:selected { background: $base; color: $text; border-top-color: $sel; }
QTabBar::tab:hover:!selected { background: $hover; }
QTabBar:focus::tab:selected { color: $sel; }
QHeaderView { background: $panel; border: 0; }
QHeaderView::section { background: $panel; color: $dim; border: 0; border-right: 1px solid $grid;
    border-bottom: 1px solid $line; padding: 4px 8px; }
QHeaderView::section:vertical { padding: 0 4px; }
QTableView, QTreeView, QListView, QTextBrowser { border: 0; gridline-color: $grid; }
QDialog QTableView, QDialog QTreeView, QDialog QListView, QDialog QTextBrowser { border: 1px solid $line; }
QTreeWidget::item, QDialog QListWidget::item { min-height: 22px; }
QListWidget::item:selected, QTreeWidget::item:selected, QTableWidget::item:selected { background: $selbg;
    color: $text; }
QListWidget::item:selected:!active, QTreeWidget::item:selected:!active, QTableWidget::item:selected:!active {
    background: $selidle; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QTableCornerButton::section { background: $panel; border: 0; }
QGroupBox { border: 0; border-top: 1px solid $line; margin-top: 20px; padding-top: 6px; }
QGroupBox::title { subcontrol-origin: margin; left: 0; color: $dim; }
QProgressBar { background: $line; border: 0; border-radius: 2px; max-height: 4px; text-align: center;
    color: transparent; }
QProgressBar::chunk { background: $sel; border-radius: 2px; }

QScrollBar { background: transparent; border: 0; }
QScrollBar:vertical { width: 12px; }
QScrollBar:horizontal { height: 12px; }
QScrollBar::handle { background: $line2; border: 3px solid transparent; border-radius: 6px; }
QScrollBar::handle:hover { background: $edge; }
QScrollBar::handle:vertical { min-height: 28px; }
QScrollBar::handle:horizontal { min-width: 28px; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
""")


def style_sheet(colours: Mapping[str, str], is_dark: bool) -> str:
    """Return the style sheet with the colours of the tokens and the marks of controls for one scheme."""
    return _SHEET.substitute(colours, marks=_MARKS.as_posix(), scheme="dark" if is_dark else "light")
