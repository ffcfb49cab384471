# gnuplot -c studies/front.gp CANDIDATES.csv FRONT.png   plots the candidates of studies/faster-walk-front.toml.
set terminal pngcairo size 900,560 font "DejaVu Sans,11"
set output ARG2
set datafile separator ","
set key bottom right
set xlabel "mean speed [in/s]"
set ylabel "total passiveness [%]"
set cblabel "air [g/in]"
set palette defined (0 "#2166ac", 0.5 "#b2abd2", 1 "#b2182b")
set cbrange [0.021:0.035]
set xrange [0:13]
set yrange [50:98]
set grid lc rgb "#dddddd"
feasible(x) = strcol(3) eq "true" ? x : NaN
set arrow from 9,50 to 9,98 nohead dt 2 lc rgb "#666666"
set arrow from 0,90 to 13,90 nohead dt 2 lc rgb "#666666"
set label "constraints: 9 in/s and 90 %" at 9.15,96.5 textcolor rgb "#444444"
plot ARG1 every ::1 using (feasible($23)):(feasible($24)):(feasible($25)) with points pt 7 ps 0.4 palette title "feasible candidates", \
     "<echo 4.7,66.1" using 1:2 with points pt 2 ps 2 lw 2 lc rgb "black" title "test 1, tuned by hand"
