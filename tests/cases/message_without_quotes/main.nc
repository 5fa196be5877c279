N10 #MSG ["X is %d", 5]
N20 #MSG [hello]
M30
