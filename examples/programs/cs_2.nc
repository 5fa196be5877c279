; #CS seed, programming example 2, with a position in each system
N5 P1 = 2
N10 #CS DEF [3][P1,15,5,2,3,4.5] (Definition and storage of a CS: ID 3)
N20 #CS DEF [2][P1,15,5,2,3,4.5] (Definition and storage of a CS: ID 2)
N30 #CS DEF [5][0,1,2,0,30,30] (Definition and storage of a CS: ID 5)
N30 #CS ON (Activation of a CS with the lastly) (programmed ID 5)
N40 G00 X0 Y0 Z0
N50 #CS OFF
N60 #CS ON [3] (Activation of the CS with ID 3)
N70 X0 Y0 Z0
N80 #CS OFF
N90 #CS DEF [3][1,1.2,1.3,0,0,33] (Redefinition of the CS with ID 3)
N100 #CS ON [3]
N110 X0 Y0 Z0
N120 X10
N130 #CS OFF
M30
