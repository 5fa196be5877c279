; a header of the shop: order 4711, price 12$
( part (nested remark) of L 3 )
%COMMENT_FORMS
N10 G90 G00 X1 (X9) Y2 ; Y9
#COMMENT BEGIN
N20 X99
#COMMENT END
N30 X3 (no closing bracket, X99
N40 M30
