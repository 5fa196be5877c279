N10 X1.5
N20 #MSG SAVE EXCLUSIVE ["d %d f %f s %s p %%", 3, V.A.ACS.ABS.X, "abc"]
N30 #MSG ["hello %D %F %S", -7, 0.25, "Z"]
N40 #FILE NAME [MSG="log.txt"]
N50 #MSG SAVE EXCLUSIVE ["%D", -7]
N60 #MSG SAVE ["quoted"]
N70 #MSG SAVE EXCLUSIVE [""]
N80 M30
