N1 #CS DEF [1] [1,0,0]
N2 #CS DEF [2] [1,0,0]
N3 #CS DEF [3] [1,0,0]
N4 #CS DEF [4] [1,0,0]
N5 #CS DEF [5] [1,0,0]
N6 #CS DEF [6] [1,0,0]
N7 M30
