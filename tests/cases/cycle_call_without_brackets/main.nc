X1
L CYCLE NAME=drill.cyc @P1=5
M30
