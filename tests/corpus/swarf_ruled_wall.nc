%SWARF (a wall that leans out along the path)
N10 #KIN ID [91]
N20 #TRAFO ON
N30 G90 G01 F1200
N40 $FOR P1 = 0, 10, 1
N50   X[10 * P1] Y[0.05 * P1 * P1] Z[-2 - 0.2 * P1] A[1.5 * P1] C[-2 * P1]
N60 $ENDFOR
N70 #TRAFO OFF
N80 M30
