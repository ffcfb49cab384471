# gnuplot -c studies/designs.gp docs/evidence/studies/designs.csv docs/pictures/designs.png   plots the speed of each design of designs.sh.
set terminal pngcairo size 900,460 font "DejaVu Sans,11"
set output ARG2
set datafile separator ","
set key above
set xlabel "best mean speed found with 90 % passiveness [in/s]"
set xrange [0:18]
set yrange [8.7:-0.7]
set grid x lc rgb "#dddddd"
set border 3
set tics nomirror
set style fill solid 0.8
row(i) = int(i) % 9               # nine designs for each seed of the tuner
larger(a, b) = a > b ? a : b
plot ARG1 every ::1 using (0.5 * larger($3, $4)):(row($0) + 0.36 * ($2 - 1.5)):(0):(larger($3, $4)):(row($0) + 0.36 * ($2 - 1.5) - 0.16):(row($0) + 0.36 * ($2 - 1.5) + 0.16):ytic($2 == 1 ? stringcolumn(1) : "") \
       with boxxyerror lc rgb "#2166ac" title "from the front's fastest, two seeds of the tuner", \
     ARG1 every ::1 using 3:(row($0) + 0.36 * ($2 - 1.5)) with points pt 7 ps 0.9 lc rgb "#f4a582" title "the front at 90 %"
