; 5:10 alarm: M140 MB MAX leads up alone: the tool stands 100 mm above the end already
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+600 FMAX
3 L M140 MB MAX
