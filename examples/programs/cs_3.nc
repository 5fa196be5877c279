; #CS seed, programming example 3: chained systems, 20 and 30 degrees about Z
N010 #CS ON [0,0,0,0,0,20] (Definition and activation of a CS under)
(the automatically defined ID 1)
(No shifts, only rotation 20 degrees around Z)
N020 G00 X10 Y0
N050 #CS ON [0,0,0,0,0,30] (Definition and activation of a CS under)
(the automatically defined ID 2)
(The result is a CS with a total rotation of 50 degrees around Z)
N060 X10 Y0
N100 #CS OFF (Deselection of CS with ID 2, after that the CS)
(with ID 2 is deleted!)
N110 X10 Y0
N200 #CS OFF (Deselection of CS with ID 1, all CS are deselected)
N210 X10 Y0
N400 M30
