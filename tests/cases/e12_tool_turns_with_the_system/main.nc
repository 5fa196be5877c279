; tool_fixed 0: the length lies along the third axis of the turned system, which is machine -Y
N10 D20
N20 #CS ON [0,0,0,90]
N30 X0 Y0 Z0
N40 M30
