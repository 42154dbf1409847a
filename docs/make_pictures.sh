#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Renders the pictures in docs/pictures from the scenes in examples/scenes:
#
#   [DRAFT=n] docs/make_pictures.sh [PROGRAMS [OUTPUT]]
#
# PROGRAMS is the folder that malus-render and malus-image are in (build/examples/examples, which examples/run.sh
# builds, unless given), OUTPUT where the pictures go (docs/pictures). DRAFT divides all numbers of samples, to see
# quickly whether everything works. Needs gnuplot for the plot and ImageMagick to put pictures side by side and reduce
# the number of colours; on two cores it takes ten minutes.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
programs=${1:-build/examples/examples}
out=${2:-docs/pictures}
scenes=examples/scenes

for tool in "$programs/malus-render" "$programs/malus-image" gnuplot convert; do
  command -v "$tool" >/dev/null || { echo "make_pictures.sh: $tool is missing" >&2; exit 2; }
done
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

render() { "$programs/malus-render" "$@"; }
show() { "$programs/malus-image" "$@"; }
spp() { echo $(($1 / ${DRAFT:-1} > 0 ? $1 / ${DRAFT:-1} : 1)); }

# A noisy picture of full colour compresses badly: 255 colours will do.
reduce() { convert "$1" -colors 255 "PNG8:$1"; }

# The box: intensity, degree and angle of linear polarisation. Most of what the spheres show is polarised weakly:
# degrees are doubled.
render "$scenes/box.xml" -o "$work/box.exr" --spp "$(spp 256)"
show "$work/box.exr" --show intensity -o "$out/box_intensity.png"
show "$work/box.exr" --show overlay --scale 2 -o "$out/box_overlay.png"
show "$work/box.exr" --show aolp --scale 2 -o "$out/box_aolp.png"
reduce "$out/box_intensity.png"
reduce "$out/box_overlay.png"

# Figure 1 of the paper: intensity, and below it the same in grey with the degree of polarisation in red, doubled.
# Figure 2: path tracing on the left, vcm on the right, the difference between them, each as S3 S1 over S2 S0; S1 to S3
# and the difference four times as bright as they are.
for scene in diffuse glossy glass glass_medium; do
  render "$scenes/$scene.xml" -D resolution=256 -o "$work/${scene}_vcm.exr" --integrator vcm --spp "$(spp 128)"
  show "$work/${scene}_vcm.exr" --show intensity -o "$work/${scene}_intensity.png"
  show "$work/${scene}_vcm.exr" --show overlay --scale 2 -o "$work/${scene}_overlay.png"
done
for scene in glossy glass glass_medium; do
  render "$scenes/$scene.xml" -D resolution=256 -o "$work/${scene}_path.exr" --integrator path --spp "$(spp 512)"
  show --compare "$work/${scene}_path.exr" "$work/${scene}_vcm.exr" --scale 4 -o "$work/${scene}_compare.png"
done
convert \( "$work"/{diffuse,glossy,glass,glass_medium}_intensity.png +append \) \
  \( "$work"/{diffuse,glossy,glass,glass_medium}_overlay.png +append \) -append +repage "$out/figure1.png"
convert "$work"/{glossy,glass,glass_medium}_compare.png -append +repage -filter box -resize 1024x "$out/figure2.png"
reduce "$out/figure1.png"
reduce "$out/figure2.png"

# The bathroom, by the algorithm that it is made for.
render "$scenes/bathroom.xml" -D width=480 -D height=320 -o "$work/bathroom.exr" --integrator vcm --spp "$(spp 96)"
show "$work/bathroom.exr" --show intensity -o "$out/bathroom_intensity.png"
show "$work/bathroom.exr" --show overlay --scale 2 -o "$out/bathroom_overlay.png"
reduce "$out/bathroom_intensity.png"
reduce "$out/bathroom_overlay.png"

# The same room full of steam.
render "$scenes/bathroom_medium.xml" -D width=480 -D height=320 -o "$work/steam.exr" --integrator vcm --spp "$(spp 32)"
show "$work/steam.exr" --show intensity -o "$out/bathroom_medium_intensity.png"
show "$work/steam.exr" --show overlay --scale 2 -o "$out/bathroom_medium_overlay.png"
reduce "$out/bathroom_medium_intensity.png"
reduce "$out/bathroom_medium_overlay.png"

# The sky: intensity, degree and angle of linear polarisation.
render "$scenes/sky_slab.xml" -D resolution=256 -o "$work/sky.exr" --spp "$(spp 256)"
show "$work/sky.exr" --show intensity --exposure 1.5 -o "$work/sky_intensity.png"
show "$work/sky.exr" --show dolp -o "$work/sky_dolp.png"
show "$work/sky.exr" --show aolp --scale 2 -o "$work/sky_aolp.png"
convert "$work"/sky_{intensity,dolp,aolp}.png +append +repage "$out/sky_slab.png"
reduce "$out/sky_slab.png"

# Fog and smoke: intensity, and in grey with the degree of polarisation.
render "$scenes/fog_lamp.xml" -D resolution=384 -D height=240 -o "$work/fog.exr" --integrator bdpt --spp "$(spp 64)"
show "$work/fog.exr" --show intensity --exposure 1.5 -o "$work/fog_intensity.png"
show "$work/fog.exr" --show overlay --exposure 1.5 -o "$work/fog_overlay.png"
render "$scenes/cloud.xml" -D resolution=384 -D height=240 -o "$work/cloud.exr" --spp "$(spp 256)"
show "$work/cloud.exr" --show intensity -o "$work/cloud_intensity.png"
show "$work/cloud.exr" --show overlay -o "$work/cloud_overlay.png"
for scene in fog cloud; do
  convert "$work/$scene"_{intensity,overlay}.png +append +repage "$out/$scene.png"
  reduce "$out/$scene.png"
done

# Sugar, as the front polarizer turns, and stress, between crossed and parallel polarizers.
for analyzer in 0 45 90 135; do
  render "$scenes/sugar_jar.xml" -D resolution=256 -D "analyzer=$analyzer" -o "$work/sugar.exr" --spp "$(spp 128)"
  show "$work/sugar.exr" --show intensity -o "$work/sugar_$analyzer.png"
done
convert "$work"/sugar_{0,45,90,135}.png +append +repage "$out/sugar_jar.png"
reduce "$out/sugar_jar.png"
for analyzer in 90 0; do
  render "$scenes/photoelastic.xml" -D resolution=384 -D "analyzer=$analyzer" -o "$work/stress.exr" --spp "$(spp 128)"
  show "$work/stress.exr" --show intensity -o "$work/stress_$analyzer.png"
done
convert "$work"/stress_{90,0}.png +append +repage "$out/photoelastic.png"
reduce "$out/photoelastic.png"

# Three sheets, and the same picture through a filter that was chosen after rendering.
render "$scenes/crossed_polarizers.xml" -o "$work/crossed.exr" --spp "$(spp 64)"
show "$work/crossed.exr" --show intensity -o "$out/crossed_polarizers.png"
show "$work/crossed.exr" --show aolp -o "$out/crossed_polarizers_aolp.png"
show "$work/crossed.exr" --filter linear:0 --show intensity -o "$out/crossed_polarizers_filtered.png"

# Glass at every angle: what the radiancemeter reads, with its standard error, beside Fresnel's equations.
component() { # FILE OBJECT COMPONENT: the first channel
  tr -d ' \n' <"$1" | sed -E "s/.*\"$2\":\{[^}]*\"$3\":\[([^],]*).*/\1/"
}
for angle in $(seq 5 5 55) 56.309932474020215 $(seq 60 5 85); do
  render "$scenes/brewster.xml" -D "angle=$angle" --spp "$(spp 65536)" -o "$work/meter.exr" --stats "$work/meter.json" >/dev/null
  echo "$angle" \
    "$(component "$work/meter.json" measurement S0)" "$(component "$work/meter.json" standard_error S0)" \
    "$(component "$work/meter.json" measurement S1)" "$(component "$work/meter.json" standard_error S1)"
done >"$work/brewster.txt"

gnuplot <<PLOT
set terminal pngcairo size 900,420 font "sans,11"
set output "$out/brewster.png"
n = 1.5
set angles degrees
q(a) = sqrt(n * n - sin(a)**2)
rs(a) = ((cos(a) - q(a)) / (cos(a) + q(a)))**2
rp(a) = ((n * n * cos(a) - q(a)) / (n * n * cos(a) + q(a)))**2
set xrange [0:90]
set xtics 15
set xlabel "angle of incidence, degrees"
set arrow from atan(n), graph 0 to atan(n), graph 1 nohead dashtype 3 linecolor "gray40"
set key top left Left reverse
set multiplot layout 1,2 title "Reflection at glass, n = 1.5: radiancemeter (points) and Fresnel's equations (lines)"
set ylabel "reflectance"
set yrange [0:1]
plot rs(x) with lines linecolor "#b02020" title "R_s = S_0 + S_1", \
     rp(x) with lines linecolor "#2040b0" title "R_p = S_0 - S_1", \
     (rs(x) + rp(x)) / 2 with lines linecolor "black" title "S_0", \
     "$work/brewster.txt" using 1:(\$2 + \$4) with points pointtype 7 pointsize 0.8 linecolor "#b02020" notitle, \
     "" using 1:(\$2 - \$4) with points pointtype 7 pointsize 0.8 linecolor "#2040b0" notitle, \
     "" using 1:2:3 with yerrorbars pointtype 7 pointsize 0.8 linecolor "black" notitle
set ylabel "degree of polarisation"
set key bottom center samplen 2
set yrange [0:1.05]
plot (rs(x) - rp(x)) / (rs(x) + rp(x)) with lines linecolor "black" title "(R_s - R_p) / (R_s + R_p)", \
     "$work/brewster.txt" using 1:(\$4 / \$2) with points pointtype 7 pointsize 0.8 linecolor "black" title "S_1 / S_0"
PLOT

ls -l "$out"
