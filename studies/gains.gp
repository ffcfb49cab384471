# gnuplot -c studies/gains.gp docs/evidence/studies/one-after-the-other.csv docs/pictures/gains.png   plots the best so far over candidates, for
# four gains at once and for joint after joint, three seeds each.
set terminal pngcairo size 900,460 font "DejaVu Sans,11"
set output ARG2
set datafile separator ","
set key above
set xlabel "candidates, three runs each"
set ylabel "least error of the foot's path so far [in]"
set xrange [0:960]
set yrange [0.9:2.2]
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
set arrow from 0,2.11 to 960,2.11 nohead dt 2 lc rgb "#666666"
set label "table 6-3, by hand" at 300,2.15 textcolor rgb "#444444"
plot for [s = 1:3] ARG1 every ::1 using (strcol(1) eq "together" && $2 == s ? $3 : NaN):4 with steps lw 2 lc rgb "#2166ac" title (s == 1 ? "all four at once" : ""), \
     for [s = 1:3] ARG1 every ::1 using (strcol(1) eq "turns" && $2 == s ? $3 : NaN):4 with steps lw 2 lc rgb "#d6604d" title (s == 1 ? "joint after joint" : "")
