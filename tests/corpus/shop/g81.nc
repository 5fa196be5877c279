(simple drilling; @P1 depth @P2 plane)
V.P.COUNT += 1
G00 @Z=@P2
G01 @Z=@P1 F100
G00 @Z=@P2
M17
