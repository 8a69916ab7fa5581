; == 450-without-rotary-axes
; 3:1 alarm: TCH PROBE 450 needs the kinematics of the machine: Setup(kinematics=…), a mnclab.Kinematics or the name of a machine
TOOL CALL 6 Z
TCH PROBE 450 SAVE KINEMATICS
Q410=0
Q409=5

; == 450-without-a-name
; 3:1 alarm: TCH PROBE 450 Q409 (memory designation) is missing
TOOL CALL 6 Z
TCH PROBE 450 SAVE KINEMATICS
Q410=0

; == 450-with-a-parameter-of-another-cycle
; 6:1 alarm: Q263=1 has no meaning in this block (TCH PROBE 450 does not take Q263) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
TOOL CALL 6 Z
TCH PROBE 450 SAVE KINEMATICS
Q410=0
Q409=5
Q263=1

; == 451-without-rotary-axes
; 3:1 alarm: TCH PROBE 451 needs the kinematics of the machine: Setup(kinematics=…), a mnclab.Kinematics or the name of a machine
TOOL CALL 6 Z
TCH PROBE 451 MEASURE KINEMATICS
Q406=1
Q407=12.5
Q320=0
Q408=0
Q253=750
Q380=0
Q411=-90
Q412=90
Q413=0
Q414=0
Q415=-90
Q416=90
Q417=0
Q418=0
Q419=90
Q420=270
Q421=0
Q422=3
Q423=4
Q431=0
Q432=0

; == 451-without-a-mode
; 3:1 alarm: TCH PROBE 451 Q406 (mode) is missing
TOOL CALL 6 Z
TCH PROBE 451 MEASURE KINEMATICS
Q407=12.5
Q320=0
Q408=0
Q253=750
Q380=0
Q411=-90
Q412=90
Q413=0
Q414=0
Q415=-90
Q416=90
Q417=0
Q418=0
Q419=90
Q420=270
Q421=0
Q422=3
Q423=4
Q431=0
Q432=0

; == 452-without-rotary-axes
; 3:1 alarm: TCH PROBE 452 needs the kinematics of the machine: Setup(kinematics=…), a mnclab.Kinematics or the name of a machine
TOOL CALL 6 Z
TCH PROBE 452 PRESET COMPENSATION
Q407=12.5
Q320=0
Q408=0
Q253=750
Q380=0
Q411=-90
Q412=90
Q413=0
Q414=0
Q415=-90
Q416=90
Q417=0
Q418=0
Q419=90
Q420=270
Q421=0
Q422=3
Q423=4
Q432=0

; == 452-sets-no-preset
; 4:1 alarm: Q431=0 has no meaning in this block (TCH PROBE 452 does not take Q431) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
TOOL CALL 6 Z
TCH PROBE 452 PRESET COMPENSATION
Q431=0
Q407=12.5
Q320=0
Q408=0
Q253=750
Q380=0
Q411=-90
Q412=90
Q413=0
Q414=0
Q415=-90
Q416=90
Q417=0
Q418=0
Q419=90
Q420=270
Q421=0
Q422=3
Q423=4
Q432=0
