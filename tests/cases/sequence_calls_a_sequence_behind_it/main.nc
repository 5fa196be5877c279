; a sequence may run blocks that stand behind its own end
N10 L SEQUENCE [N30 N40]
N20 X5
N30 X1
N40 X2
N50 L SEQUENCE [N10]
M30
