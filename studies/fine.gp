# gnuplot -c studies/fine.gp FOLDER docs/evidence/studies docs/pictures   plots the maps of studies/fine.sh, and as circles the points of the
# tables in the repository, as maps.png and largest-gains.png.
set terminal pngcairo size 1320,760 font "DejaVu Sans,9" noenhanced
set output ARG3 . "/maps.png"
set datafile separator ","
set multiplot layout 2,3
set border 3
set tics nomirror
set key off
fine(name) = ARG1 . "/" . name . ".csv"
coarse(name) = ARG2 . "/" . name . ".csv"
blue = "#2166ac"; red = "#b2182b"

set title "zero-gap without foam (blue), with force feedback (red)"
set xlabel "table [in]"; set ylabel "distance [in]"
plot fine("table-height") every ::1 using 1:3 with dots lc rgb blue, fine("table-height-felt") every ::1 using 1:3 with dots lc rgb red, \
     coarse("table-height") every ::1 using 1:3 with points pt 6 lc rgb blue, coarse("table-height-felt") every ::1 using 1:3 with points pt 6 lc rgb red

set title "no-stiffness-control: steps repeat to [in]"
set xlabel "damping of the hip [lbf in s/rad]"; set ylabel "of the knee"
set logscale cb; set cbrange [0.02:5]
set palette defined (0 "#2166ac", 0.5 "#f7f7f7", 1 "#b2182b")
set xrange [0.2:2.07]; set yrange [0.2:2.07]
plot fine("repeat-damping") every ::1 using 1:2:4 with points pt 5 ps 0.75 palette
set xrange [*:*]; set yrange [*:*]

set title "test 1 with a payload"
set yrange [40:60]
set xlabel "payload [lb]"; set ylabel "distance [in]"
plot fine("payload") every ::1 using 1:3 with dots lc rgb blue, coarse("payload") every ::1 using 1:3 with points pt 6 lc rgb blue

set title "derivative-control"
set yrange [*:*]
set logscale x
set xlabel "velocity gain [% s/count]"; set ylabel "hip's excursion [deg]"
plot fine("velocity-gain") every ::1 using 1:3 with dots lc rgb blue, coarse("velocity-gain") every ::4 using 1:3 with points pt 6 lc rgb blue
set ylabel "turning points of the hip in four swings"
plot fine("velocity-gain") every ::1 using 1:($7 + 0.8 * (rand(0) - 0.5)) with dots lc rgb blue, coarse("velocity-gain") every ::4 using 1:7 with points pt 6 lc rgb blue
unset logscale x

set title "leg-in-air"
set xlabel "desired stiffness of the hip [lbf in/rad]"; set ylabel "range of the hip [deg]"
plot fine("range-stiffness") every ::1 using 1:($3 - $2) with dots lc rgb blue, coarse("range-stiffness") every ::1 using 1:($3 - $2) with points pt 6 lc rgb blue
unset multiplot

set terminal pngcairo size 1000,640 font "DejaVu Sans,9" noenhanced
set output ARG3 . "/largest-gains.png"
set multiplot layout 2,2
set title "leg-in-air"
set ylabel "largest angle gain of the hip [%/count]"
dot = "with points pt 7 ps 0.25 lc rgb blue"
set logscale y
set yrange [0.1:0.5]
set ytics (0.1, 0.15, 0.2, 0.3, 0.4)
set xlabel "desired stiffness of the hip [lbf in/rad]"
plot fine("gain-stiffness") every ::1 using 1:3 @dot, coarse("gain-stiffness") every ::1 using 1:3 with points pt 6 lc rgb blue
unset logscale y
set yrange [*:*]
set ytics autofreq
set xlabel "stiffness gain of the hip [%/(lbf in/rad)]"
plot fine("gain-stiffness-gain") every ::1 using 1:3 @dot, coarse("gain-stiffness-gain") every ::1 using 1:3 with points pt 6 lc rgb blue
set xlabel "duration of the swing [s]"
plot fine("gain-duration") every ::1 using 1:3 @dot, coarse("gain-duration") every ::1 using 1:3 with points pt 6 lc rgb blue
set xlabel "inertia of the femur [lb in2]"
plot fine("gain-inertia") every ::1 using 1:3 @dot, coarse("gain-inertia") every ::1 using 1:3 with points pt 6 lc rgb blue
unset multiplot
