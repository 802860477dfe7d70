"""The house protocol: frames, messages, transactions and whole transfers between the studio and a control.

Bottom up: ``frame``, ``message``; then the client's ``transaction``, ``window``, ``streaming``, ``connection``,
``download_transfer`` and ``upload_transfer``, ``session``. ``docs/protocols/exchange.md`` specifies it; it is frozen.
"""
