; machine: delta, kinematics: delta.py
; a square with the delta machine, then a circle of points in polar coordinates
N10 #TRAFO [500]
N20 G00 X0 Y0 Z0
N30 G01 X30 Y-30 F2000
N40 X30 Y30
N50 X-30 Y30
N60 #TRAFO PCS ID [501]
N70 #TRAFO PCS ON
N80 X40 Y0
N90 X40 Y90
N100 X40 Y180
N110 #TRAFO PCS OFF
N120 #TRAFO OFF
N130 M30
