; manner: post of SolidCAM, radius compensation in the control, RR round an outside contour
; RR on the way to +X along Y10: the tool stands 5 mm below (Y5); up along X90: 5 mm to the right (X95)
; at 17: 10, 5, -5
; through 18: 90, 5, -5
; through 19: 95, 50, -5
; through 20: 10, 55, -5
; at 21: 5, 10, -5
; at 22: -15, -15, -5
; at 23: -15, -15, 50
0 BEGIN PGM PROFILE_RR MM
1 BLK FORM 0.1 Z X0. Y0. Z-25.
2 BLK FORM 0.2 X100. Y60. Z0.
3 TOOL CALL 1 Z S2000 F400
4 L Z50. R0 FMAX M3
5 L X-15. Y-15. R0 FMAX M8
6 L Z-5. F MAX
7 L X10. Y10. RR F400
8 L X90.
9 L Y50.
10 L X10.
11 L Y10.
12 L X-15. Y-15. R0 F MAX
13 L Z50. FMAX M30
14 END PGM PROFILE_RR MM
