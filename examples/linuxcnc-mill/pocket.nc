(a pocket with round ends, and a row of short moves; zero where the machine has it)
G21 G90 G17 G94 G64 P0.02
G0 X-60 Y-40
Z-20
G1 Z-22 F600
X-160 F2400
G3 X-160 Y-60 I0 J-10
G1 X-60
G3 X-60 Y-40 I0 J10
G1 X-66
X-70 Y-45
X-74 Y-46.5
X-78 Y-47.4
X-82 Y-47.9
X-86 Y-48
X-90 Y-47.7
X-94 Y-47
G0 Z-20
X0 Y0
M2
