; NPOS is a name and no block number with a parameter; [N20] is not N20:
$GOTO [NPOS]
X1
[NPOS] Y1
$GOTO [N20]
N20: X2
[N20] X3
M30
