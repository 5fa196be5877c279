(machine builder: before each program)
V.S.CHANGES = 0
V.P.START = 1
G00 G17 G90
M17
