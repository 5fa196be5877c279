N10 #MACHINE DATA [AX=X AXPARAM="kenngr.swe_pos 0xC350"]
N20 X6
N30 #MACHINE DATA [AX=X AXPARAM="kenngr.swe_pos nan"]
M30
