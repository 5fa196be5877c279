N10 #MSG SYN HMI ["one"]
N20 #MSG [PLC] ["two"]
N30 #MSG SYN_ACK EVENT_LOGGER ["three %d", 3]
N40 X1
N50 #MSG NOBODY ["four"]
