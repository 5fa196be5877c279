; #CS seed, programming example 1, with a position in each system
N005 P1 = 2
N010 #CS DEF [1][P1,15,5,20,30,45] (Definition of a CS)
(under ID 1:)
(Relative shifts: X2, Y15, Z5)
(Rotations: 45 degrees around Z, 30 around Y')
(20 around X'')
N020 #CS ON[1] (Activation of CS with ID 1)
N030 G00 X0 Y0 Z0
N040 X10
N050 X0 Y10
N060 Y0 Z10
N070 X1 Y2 Z3
N100 #CS OFF (De-activation of CS with ID 1)
N110 X1 Y2 Z3
N200 P1=10
N210 #CS ON [P1,15,5,2,3,60] (Definition and activation of a CS)
(under the automatically defined ID 2)
N220 X0 Y0 Z0
N300 #CS OFF (Deselection of the latest activated CS: ID2)
(After that the CS with ID2 is deleted!)
N310 X0 Y0 Z0
N400 M30
