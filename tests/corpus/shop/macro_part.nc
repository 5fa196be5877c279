%MACRO_PART (parametric part written with macros, as post-processors of the 90s did)
( --- technology --- )
"SAFE"     = "G00 Z50"
"FEED_Z"   = "F150"
"FEED_XY"  = "F[60 * \"FACTOR\"]"
"FACTOR"   = "7.5"
"DOWN"     = "G01 Z[-V.P.DEPTH] \"FEED_Z\""
"WIDTH"    = "[V.P.OUTER - 2*\"WALL\"]"
"WALL"     = "3.25"
"CORNER1"  = "X-\"HALF\" Y-\"HALF\""
"CORNER2"  = "X\"HALF\" Y-\"HALF\""
"CORNER3"  = "X\"HALF\" Y=\"HALF\""
"CORNER4"  = "X=-\"HALF\" Y\"HALF\""
"HALF"     = "[\"WIDTH\"/2]"
"ROUND"    = "G01 \"CORNER2\" \"FEED_XY\""
( --- data of the part --- )
N10 V.P.OUTER = 60 V.P.DEPTH = 0
N20 V.P.NAME = "pocket"
N30 G90 G17 "SAFE"
N40 X0 Y0
N50 $WHILE V.P.DEPTH < 6
N60   V.P.DEPTH += 2.5
N70   $IF V.P.DEPTH > 6
N80     V.P.DEPTH = 6
N90   $ENDIF
N100  "CORNER1"
N110  "DOWN"
N120  "ROUND"
N130  "CORNER3"
N140  "CORNER4"
N150  "CORNER1"
N160  "SAFE"
N170  "WALL" = "3.75" (finishing passes are smaller)
N180  #MSG SAVE EXCLUSIVE ["%s %s at %s", V.P.NAME, LEFT[REAL_TO_STR["WIDTH"],5], REAL_TO_STR[V.P.DEPTH]]
N190 $ENDWHILE
N200 $IF MACRO_LENGTH["WALL"] == 4 && LEN[V.P.NAME + "_1"] == 8
N210   "SAFE" = "G00 Z75"
N220 $ENDIF
N230 "SAFE"
N240 "SUB" = "side_" 
N250 P1 = FIND[V.P.NAME, "ck"] P2 = ORD["A", 1]
N260 XP1 YP2
N270 #INIT MACRO TAB
N280 $IF EXIST[V.P.OUTER] && NOT[EXIST[V.P.INNER]]
N290   Z100
N300 $ENDIF
N310 M30
