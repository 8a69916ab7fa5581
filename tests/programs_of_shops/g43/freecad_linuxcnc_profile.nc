(Exported by FreeCAD)
(Post Processor: linuxcnc_post)
(Output Time:2024-01-05 12:00:00.000000)
(Begin preamble)
G17 G54 G40 G49 G80 G90
G21
(Begin operation: Fixture)
(Path: Fixture)
G54
(Finish operation: Fixture)
(Begin operation: TC: 6mm)
(Path: TC: 6mm)
(TC: 6mm)
(Begin toolchange)
M5
M6 T1
G43 H1
M3 S8000
(Finish operation: TC: 6mm)
(Begin operation: Profile)
(Path: Profile)
(Compensated Tool Path. Diameter: 6.0)
G0 Z15.000
G0 X-3.000 Y0.000
G0 Z3.000
G1 X-3.000 Y0.000 Z-2.000 F300.000
G1 X-3.000 Y30.000 Z-2.000 F600.000
G2 X0.000 Y33.000 Z-2.000 I3.000 J-0.000 K0.000 F600.000
G1 X40.000 Y33.000 Z-2.000 F600.000
G2 X43.000 Y30.000 Z-2.000 I0.000 J-3.000 K0.000 F600.000
G1 X43.000 Y0.000 Z-2.000 F600.000
G0 Z15.000
(Finish operation: Profile)
(Begin postamble)
M05
G17 G54 G90 G80 G40
M2
