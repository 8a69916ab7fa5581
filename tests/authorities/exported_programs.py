"""Programs whose export as plain blocks is read by LinuxCNC: name -> (control, text)."""

PROGRAMS = {
    "arcs in three planes": (
        "mnc",
        "G90 G54 S1000 M3\nG0 X0.1 Y0 Z5\nG1 Z-2 F100\nG2 X30 Y0.3 R20\nG4 P1.5\nG3 X10 R-20\nG3 I5\n"
        "G18 G2 X40 Z-4 R-17\nG19 G3 Y8 Z-4 R5\nG17 G2 I3 J4\nM5\n",
    ),
    "helices and short arcs": (
        "mnc",
        "G90 G54\nG1 X1 F200\nG3 X30 Y0.3 Z-4 R40\nG3 I5 Z-7\nG2 X30.0000001 I2000\nG2 X30.004 I0.002\nG1 X7 F50.5\n",
    ),
    "rotation, mirror image, poles, tools": (
        "mnc",
        "G90 G54\nT1\nG0 X0 Y0 Z5\nG17 G39 X5 Y5 A30\nG1 X20 F300\nG3 X30 Y10 R10\nG38\nG51 X1\nG0 X-20 Y-20\n"
        "G2 X-10 Y-10 R10\nG50\nT2\nG0 X0 Y0\nG16 X1 Y1\nG11 R10 A33.3\nG13 A250\n",
    ),
    "klartext": (
        "tnc-620",
        "BEGIN PGM A MM\nTOOL CALL 1 Z S2000\nL X+0 Y+0 Z+10 R0 FMAX M3\nL Z-5 F200\nCC X+20 Y+0\nC X+40 Y+0 DR-\n"
        "L X+60 Y+20 F500\nRND R4\nL X+80\nL Y+50\nL Z+50 FMAX M30\nEND PGM A MM\n",
    ),
    "turning": ("nc-31", "S800\nM3\nF20\nX4000 ~ *\nZ200 ~\nZ-1000\nX5000\nX5500 *\nZ-1500\nX6000 ~\n"),
}
