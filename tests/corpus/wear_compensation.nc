%WEAR (depth in three passes, wear from a table by tool)
#VAR
 V.P.WEAR[2][3] = [0.01, 0.02, 0.03, 0.1, 0.2, 0.3]
#ENDVAR
N10 G90 G00 X0 Z5
N20 $FOR P1 = 0, 1, 1
N30   $FOR P2 = 0, 2, 1
N40     G01 Z[-P2 - V.P.WEAR[P1][P2]] F100
N50   $ENDFOR
N60   G00 Z5
N70 $ENDFOR
N80 M30
