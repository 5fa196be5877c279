%main (name
N10G01X10Y-20.5F100
; nothing

X[1+2*3] Y=2**3
N30 X SIN[30] Z-.5
M30
