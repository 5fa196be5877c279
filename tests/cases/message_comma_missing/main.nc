N10 #MSG ["X is %d" 5]
M30
