; 2:9 alarm: FAUTO needs a feed in the TOOL CALL block (write TOOL CALL … F500)
1 L X+5 FAUTO
