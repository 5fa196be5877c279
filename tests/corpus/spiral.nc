%SPIRAL (Archimedes, 0.5 mm a turn of 36 steps)
N10 G90 G01 X0 Y0 F1200
N20 $FOR P1 = 1, 72, 1
N30   P2 = 0.5 * P1 / 36
N40   X[P2 * COS[10 * P1]] Y[P2 * SIN[10 * P1]]
N50 $ENDFOR
N60 M30
