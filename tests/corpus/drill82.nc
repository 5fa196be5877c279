(@P1: depth, @P2: retract plane, @P3: feed)
G90 G01 Z@P1 F@P3
G00 Z@P2
M17
