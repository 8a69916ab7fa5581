; 3:16 alarm: an operator is missing before the bracket (one of & | ^ \)
%A G71 *
N10 QC10 = QC1 ( QC2 ) *
N99 %A G71 *
