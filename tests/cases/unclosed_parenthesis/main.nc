N10 X1 (closed by the end of the line
N20 Y2 (nested (comment) X9) Z3
N30 X4 (off Y5
N40 M30
