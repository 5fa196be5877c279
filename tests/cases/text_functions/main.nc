; the values that the programming manual shows
P1 = LEN["Hello world! How are you?"] P2 = ORD["Hello world!", 7] P3 = ORD["Hello world!"]
XP1 YP2 ZP3
V.P.A = "Hello world! How are you?"
X FIND[V.P.A, "How"] Y FIND[V.P.A, "how"] Z0
#MSG SAVE EXCLUSIVE ["%s", LEFT["Hello world!", 5] + "|" + MID["How are you?", 3, 5] + "|" + RIGHT[V.P.A, 12]]
M30
