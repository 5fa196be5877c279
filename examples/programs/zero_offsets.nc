%zero_offsets
; machine: zero_list. Group 2 (G55) is active after the start (default_index 2).
N10 G00 X0 Y0 Z0
N20 G54 X0 Y0 Z0      ; Y and Z are left out of group 1 (inaktiv 1)
N30 G56 X0 Y0 Z0
N40 G57 X0 Y0 Z0
N50 G159=7 X0 Y0 Z0
N60 G159=8 X0 Y0 Z0
N70 G160=2 X1 Y0 Z1   ; leave X and Z out of group 2
N80 G55
N90 X0 Y0 Z0
N100 M30
