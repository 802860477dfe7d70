"""Plain files to and from any control that takes one: XMODEM, YMODEM, and raw as a tape punch and reader do it."""
