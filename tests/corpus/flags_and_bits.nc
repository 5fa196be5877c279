%FLAGS (bits of a status word choose what is made)
N10 G90 G00 X0 P1 = 13
N20 $FOR P2 = 0, 3, 1
N30   $IF [P1 & 2 ** P2] > 0
N40     X[10 * P2] Y[P1 MOD 5]
N50   $ENDIF
N60 $ENDFOR
N70 M30
