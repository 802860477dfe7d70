"""The exchange with controls: drivers and the client that uses them, over TCP and serial lines; emulated controls.

``links`` carry bytes, ``house`` is the protocol of the emulated controls over them, ``client`` puts files into controls
and compares them, ``emulated`` is the other end. An image is bytes for all of them; ``image`` knows what they mean.
``docs/protocols`` specifies the wire.
"""
