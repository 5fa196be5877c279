; the motion belongs to the block that uses the macro
"POS" = "X500 Y200"
"MOVE" = "G01 \"POS\" F1000"
N30 "MOVE"
"MOVE" Z5
M30
