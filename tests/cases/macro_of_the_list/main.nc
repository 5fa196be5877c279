; the list has RELPOS (X10 Y20 relative) and STEP; a program may write over them until the
; table is initialised
"RELPOS"
Z"STEP"
"STEP" = "7"
Z"STEP"
#INIT MACRO TAB
Z["STEP"*2]
"RELPOS"
M30
