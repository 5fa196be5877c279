#FILE NAME [G82="d.nc"]
G82 [12 !]
M30
