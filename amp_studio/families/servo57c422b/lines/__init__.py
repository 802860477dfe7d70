"""The live registers of a rack: what they contain, the line to them,
and the driver with the command handshake.
"""
