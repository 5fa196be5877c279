; machine: ac_table. The tool winds down a dome along its normal, with RTCP; the line of the move
; runs once for each point, so the workbench lists its runs.
N10 G54 G90
N20 V.G.WZ_AKT.L = 120
P1 = 40 (radius of the dome)
P2 = 36 (moves per turn)
P3 = 12 (turns)
N30 G00 X0 Y0 Z150 A0 C0
N40 #KIN ID [91]
N50 #TRAFO ON
N60 #CS ON [60, 40, 10, 0, 0, 0]
N70 G00 X0 Y0 Z[P1 + 20]
$FOR P10 = 0, P2 * P3, 1
P11 = 60 * P10 / [P2 * P3] (tilt from the top, degrees)
P12 = 360 * P10 / P2 (angle around the dome)
N100 G01 X[P1 * SIN[P11] * COS[P12]] Y[P1 * SIN[P11] * SIN[P12]] Z[P1 * COS[P11]] A[-P11] C[-90 - P12] F2000
$ENDFOR
N200 G00 Z[P1 + 20]
N210 #CS OFF
N220 #TRAFO OFF
N230 M30
