%DRILL_PLATE (grid of deep holes, modal, one hole left out)
N010 G17 G90 G94 F1000
N020 V.P.STROKES = 0
N030 #VAR
N040   V.L.ROWS : UNS08 = 2
N045   V.L.R    : SGN16
N050   V.L.COLS : UNS08 = 3
N060   V.P.SKIP[2][3] : BOOLEAN = [FALSE, FALSE, TRUE, \
                                   FALSE, FALSE, FALSE]
N070 #ENDVAR
N080 G00 X-20 Y-20 Z50
N090 S1500 M03
; the cycle runs at its call too: hole at X10 Y10
N100 G00 X10 Y10
N110 L CYCLE [NAME=deep_drill.cyc MODAL_MOVE \
       @P1=-12 @P2=2 \    ; depth, plane
       @P3=6 @P4=2 \
       @P6=0 ]
N120 $FOR V.L.R = 0, V.L.ROWS-1, 1
N130   $FOR P2 = 0, V.L.COLS-1, 1
N140     $IF V.P.SKIP[V.L.R][P2] || [V.L.R == 0 && P2 == 0]
N150       $CONTINUE
N160     $ENDIF
N170     X[10+15*P2] Y[10 + 12*V.L.R]
N180   $ENDFOR
N190 $ENDFOR
N200 #DISABLE MODAL CYCLE
N210 G00 Z50
N220 #MSG SAVE EXCLUSIVE ["strokes %d", V.P.STROKES]
N230 G18 (drilling along Y)
N240 G00 X0 Z0 Y30
N250 L CYCLE [NAME=deep_drill.cyc @P1=15 @P2=25 @P3=4 @P5=3 @P6=1]
N260 G17
N270 M05
N280 X0 Y40
N290 M30
