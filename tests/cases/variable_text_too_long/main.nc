#VAR
V.P.A : STRING[3]
#ENDVAR
V.P.A = "abcd"
M30
