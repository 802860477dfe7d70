"""Exchanges with a control: download, upload, verify, restore, the sheet by hand."""
