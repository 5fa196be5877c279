%SKIPPED_HOLES (level 2: prototype without the outer holes)
N10 G90 G00 X0 Y0 Z5
N20 X10
/2 N30 X20
/2 N40 X30
N50 X40
/5 N60 Y99
N70 M30
