%APPROACH (along a line of given angle and length)
N10 G90 G00 X5 Y5 P1 = 37 P2 = 12.5
N20 G91 G01 X[P2 * COS[P1]] Y[P2 * SIN[P1]] F400
N30 X[-P2 * COS[P1]] Y[-P2 * SIN[P1]]
N40 P3 = ATAN2[3, 4] P4 = SQRT[3 ** 2 + 4 ** 2]
N50 X[P4 * COS[P3]] Y[P4 * SIN[P3]]
N60 G90
N70 M30
