#!/usr/bin/env bash
# Regenerates every picture that the book and the README show, by running the program.
#
#   cargo build --release && docs/refresh-pictures.sh
#
# SLIDEWAY=path runs another binary. The same program makes the same bytes. Look at each picture that changes before
# committing it. (page.png alone is taken of the page in the browser, by `node web/tools/picture.js`.)
set -euo pipefail
cd "$(dirname "$0")/.."
slideway=${SLIDEWAY:-target/release/slideway}
pictures=docs/src/pictures
mkdir -p "$pictures"

# draw FILE ARGUMENTS...
draw() {
    local file=$1
    shift
    "$slideway" draw "$@" --output "$pictures/$file" --force
}

draw drawer.svg models/drawer.toml
draw drawer-jam.svg models/drawer.toml --set mu=0.7
draw klepp-2002.svg models/klepp-2002.toml
draw klepp-2002-dark.svg models/klepp-2002.toml --theme dark
draw painleve-klein-two.svg models/painleve-klein.toml --set mu=4 --set direction=-1
draw slider-crank-tipped.svg models/slider-crank.toml --set mu=0.8 --at "phi=150 deg"
draw cam-follower.svg models/cam-follower.toml
draw wedge.svg models/wedge.toml
draw scotch-yoke.svg models/scotch-yoke.toml
draw sleeve-on-arm.svg models/sleeve-on-arm.toml
draw telescopic-boom.svg models/telescopic-boom.toml
draw drawer-on-two-rails.svg models/drawer-on-two-rails.toml
draw carriage-on-two-rods.svg models/carriage-on-two-rods.toml
draw gate-on-two-posts.svg models/gate-on-two-posts.toml
draw three-pad-telescope.svg models/three-pad-telescope.toml
draw boom-in-wind.svg models/boom-in-wind.toml
draw drawer-on-runners.svg models/drawer-on-runners.toml
draw slider-crank-with-pins.svg models/slider-crank-with-pins.toml
draw toggle-press.svg models/toggle-press.toml
draw bell-crank.svg models/bell-crank.toml
draw four-bar.svg models/four-bar.toml
draw quick-return.svg models/quick-return.toml
draw over-centre-clamp.svg models/over-centre-clamp.toml
draw bracket-on-pole.svg models/bracket-on-pole.toml
draw ladder.svg models/ladder.toml
draw box-on-incline.svg models/box-on-incline.toml
draw rod-on-floor.svg models/rod-on-floor.toml
draw peg-in-hole.svg models/peg-in-hole.toml
draw latch-with-pawl.svg models/latch-with-pawl.toml
draw cam-and-spring.svg models/cam-and-spring.toml
draw nip-of-rolls.svg models/nip-of-rolls.toml
draw shaft-in-v-block.svg models/shaft-in-v-block.toml
draw woodpecker.svg models/woodpecker.toml
draw clamp.svg docs/src/examples/clamp.toml
draw bracket.svg docs/src/examples/bracket.toml
# Plots.

# plot FILE ARGUMENTS...: limits with a plot.
plot() {
    local file=$1
    shift
    "$slideway" limits "$@" --plot "$pictures/$file" --force >/dev/null
}

plot klepp-figure-4.svg models/klepp-2002.toml --vary mu_1=0..0.8 --set F_20=0
plot klepp-figures-4-and-5.svg models/klepp-2002.toml --vary mu_1=0..0.8 --set F_20=0 --both-directions
plot klepp-preload.svg models/klepp-2002.toml --vary mu_1=0..0.8 --both-directions
"$slideway" sweep models/klepp-2002.toml --vary mu_1=0..0.8:801 --plot "$pictures/sweep-klepp.svg" --force >/dev/null 2>&1
plot drawer-push.svg models/drawer.toml --vary mu=0..1 --quantity effort
plot slider-crank.svg models/slider-crank.toml --vary "phi=-80 deg..80 deg" --quantity acceleration
"$slideway" drive models/drawer.toml --vary mu --plot "$pictures/drive-drawer.svg" --force >/dev/null
"$slideway" size models/drawer.toml --vary "L=200 mm..900 mm" --margin 2 --plot "$pictures/size-drawer.svg" --force >/dev/null
"$slideway" sweep models/drawer.toml --vary "mu=normal(0.6, 0.05)" --samples 20000 --plot "$pictures/samples-drawer.svg" --force \
    >/dev/null 2>&1

# Maps.
"$slideway" map models/four-bar.toml --x "phi=0 deg..360 deg" --y mu_pin=0..1 --output "$pictures/map-treadle.svg" --force
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
"$slideway" new axis --output - >"$work/axis.toml"
"$slideway" map "$work/axis.toml" --x "a=-300 mm..300 mm" --y "h=-300 mm..300 mm" --output "$pictures/map-axis.svg" --force
"$slideway" new column --output - >"$work/column.toml"
"$slideway" map "$work/column.toml" --x "a=-300 mm..300 mm" --y "b=-300 mm..300 mm" --output "$pictures/map-column.svg" --force
"$slideway" map models/klepp-2002.toml --x mu_1=0..0.8 --y "F_20=0 N..15 N" --output "$pictures/map-solutions.svg" --force
"$slideway" map models/klepp-2002.toml --x mu_1=0..0.8 --y "alpha=60 deg..88 deg" --set F_20=0 --colour-by modes \
    --output "$pictures/map-modes.svg" --force
"$slideway" map models/peg-in-hole.toml --x mu=0..0.4 --y off=-30mm..30mm --output "$pictures/map-peg.svg" --force
"$slideway" map models/drawer.toml --x mu=0..1 --y "L=200 mm..500 mm" --colour-by margin \
    --output "$pictures/map-margin.svg" --force
"$slideway" map models/klepp-2002.toml --x mu_1=0..0.8 --y "alpha=60 deg..88 deg" --set F_20=0 --colour-by jam \
    --output "$pictures/map-jam.svg" --force

# Motions.
# motion FILE OPTION ARGUMENTS...: a plot or a moving picture of a motion.
motion() {
    local file=$1 option=$2
    shift 2
    "$slideway" simulate "$@" "$option" "$pictures/$file" --force >/dev/null
}

motion motion-oscillator.svg --plot models/frictional-oscillator.toml --until 2s
motion motion-stick-slip.svg --plot models/stick-slip.toml --until 4s
motion motion-drawer-jam.svg --plot models/thrown-drawer.toml --until 0.6s
motion portrait-drawer-jam.svg --plot models/thrown-drawer.toml --until 0.6s --phase-portrait
motion motion-drawer-stop.svg --plot models/thrown-drawer.toml --until 0.6s --set "x_s=0.2 m"
motion motion-klepp.svg --plot models/klepp-2002-spring.toml --until 2s
motion animation-oscillator.svg --animate models/frictional-oscillator.toml --until 1.6s --slow-motion 5
motion animation-stick-slip.svg --animate models/stick-slip.toml --until 2s --slow-motion 4
motion animation-klepp.svg --animate models/klepp-2002-spring.toml --until 1s --slow-motion 8
motion animation-drawer.svg --animate models/thrown-drawer.toml --until 0.5s --slow-motion 10
motion animation-crank.svg --animate models/slider-crank.toml --until 30ms --slow-motion 120
motion animation-trammel.svg --animate models/elliptic-trammel.toml --until 1.2s --slow-motion 4
motion animation-sleeve.svg --animate models/sleeve-on-arm.toml --until 0.6s --slow-motion 6
motion animation-woodpecker.svg --animate models/woodpecker.toml --until 0.3s --slow-motion 20
motion motion-rattling-drawer.svg --plot models/rattling-drawer.toml --until 0.12s
motion animation-rod-jam.svg --animate models/rod-on-floor.toml --set turning=0 --until 0.9s --slow-motion 4
motion animation-boom.svg --animate models/telescopic-boom.toml --until 0.6s --slow-motion 6
draw drawer-before-the-jam.svg models/thrown-drawer.toml --at x=0.29 --rate x=1.2 --solution 2
draw motion-near-the-jam.svg models/klepp-2002-spring.toml --set mu_1=0.44 --set direction=-1
