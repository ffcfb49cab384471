# gnuplot -c studies/random-legs.gp DISTANCE.csv PARAMETERS.csv PICTURE.png   plots how far random legs walk, how strongly each parameter
# determines it, and the parameters of the legs that have the six numbers of the thesis.
set terminal pngcairo size 1200,560 font "DejaVu Sans,10" noenhanced
set output ARG3
set datafile separator ","
set multiplot layout 1,3
set border 3
set tics nomirror
set key off

set title "Distance of test 1"
set xlabel "distance [in]"
set ylabel "legs per inch"
set xrange [0:120]
set yrange [0:3600]
set style fill solid 1
set lmargin at screen 0.065
set rmargin at screen 0.36
set object 1 rectangle from 55,graph 0 to 60,graph 1 fillcolor rgb "#fddbc7" fillstyle solid 1 noborder behind
set label 1 "thesis: 55 to 60 in;\nits track ends at 60 in" at 62,graph 0.97 textcolor rgb "#b2182b"
plot ARG1 every ::1 using ($1 + 0.5):2:(0.9) with boxes lc rgb "#2166ac"
unset object 1
unset label

set title "Rank correlation with the distance"
set xlabel "rank correlation"
unset ylabel
set xrange [-0.5:0.5]
set yrange [20.5:0.5]
set lmargin at screen 0.56
set rmargin at screen 0.76
set arrow 1 from 0,graph 0 to 0,graph 1 nohead lc rgb "#888888"
name(s) = s[1:strstrt(s, " [") > 0 ? strstrt(s, " [") - 1 : strlen(s)]
plot ARG2 every ::1 using ($4 / 2):($0 + 1):(abs($4) / 2):(0.35):ytic(name(strcol(1))) with boxxyerror lc rgb "#2166ac"

set title "Legs that agree with the thesis"
set xlabel "5 to 95 %, median; red: as fitted"
set xrange [0:1]
set format y ""
set lmargin at screen 0.79
set rmargin at screen 0.98
set arrow 1 from 0.5,graph 0 to 0.5,graph 1 nohead lc rgb "#dddddd"
share(x, low, high) = (x - low) / (high - low)
plot ARG2 every ::1 using (share($6, $2, $3)):($0 + 1):(share($8, $2, $3) - share($6, $2, $3)):(0) with vectors nohead lw 4 lc rgb "#92c5de", \
     ARG2 every ::1 using (share($7, $2, $3)):($0 + 1) with points pt 7 ps 0.9 lc rgb "#2166ac", \
     ARG2 every ::1 using (share($5, $2, $3)):($0 + 1) with points pt 2 ps 1.2 lw 2 lc rgb "#b2182b"
unset multiplot
