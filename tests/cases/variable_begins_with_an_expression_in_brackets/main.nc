P1=4
#VAR
V.P.A = [P1 + 2] / 3
V.P.B[2] = [[P1 + 2] * 2, -[P1]]
#ENDVAR
XV.P.A YV.P.B[0] ZV.P.B[1]
M30
