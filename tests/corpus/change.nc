(moves to the changing position, with the zero length)
V.G.WZ_AKT.L = 0
G90 G00 Z400
G00 X-50
M17
