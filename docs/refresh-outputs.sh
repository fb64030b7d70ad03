#!/usr/bin/env bash
# Regenerates every program output that the book includes, by running the program.
#
#   cargo build --release && docs/refresh-outputs.sh
#
# SLIDEWAY=path runs another binary. Each output begins with the command that made it, so a page cannot show a
# command beside the output of another. An exit code that is not the expected one stops the script.
set -euo pipefail
cd "$(dirname "$0")/.."
slideway=${SLIDEWAY:-target/release/slideway}
output=docs/src/output
examples=docs/src/examples

# show FILE EXIT_CODE ARGUMENTS...: the command line, then all that it prints.
show() {
    local file=$1 expected=$2 code=0
    shift 2
    {
        printf '$ slideway'
        local argument
        for argument in "$@"; do
            case $argument in
                *[!A-Za-z0-9_./=+-]*) printf ' "%s"' "$argument" ;;
                *) printf ' %s' "$argument" ;;
            esac
        done
        printf '\n'
        NO_COLOR=1 "$slideway" "$@" 2>&1 || code=$?
    } >"$output/$file"
    if [ "$code" -ne "$expected" ]; then
        echo "$output/$file: exit code $code, expected $expected" >&2
        cat "$output/$file" >&2
        exit 1
    fi
}

# raw FILE ARGUMENTS...: standard output alone.
raw() {
    local file=$1
    shift
    "$slideway" "$@" >"$output/$file"
}

# The paper's example.
show klepp.txt 0 solve models/klepp-2002.toml
show klepp-two.txt 0 solve models/klepp-2002.toml --set F_20=0 --set mu_1=0.6
show klepp-jam.txt 1 solve models/klepp-2002.toml --set F_20=0 --set direction=-1
show klepp-boundary.txt 0 solve models/klepp-2002.toml --set F_20=0 --set direction=-1 --set "mu_1=1/tan(alpha)"
show klepp-gap.txt 0 solve models/klepp-2002.toml --set F_20=0 --set "F_30=0.5*m*g" --set mu_1=0.24
show klepp-range.txt 0 solve models/klepp-2002.toml --set F_20=0 --set mu_1=0.4..0.6
show limits-klepp.txt 0 limits models/klepp-2002.toml --vary mu_1=0..0.8 --set F_20=0 --both-directions
show limits-klepp-preload.txt 0 limits models/klepp-2002.toml --vary mu_1=0..0.8
show limits-drawer-length.txt 0 limits models/drawer.toml --set mu=0.6 --vary "L=0.2 m..0.5 m"
raw klepp-two.json solve models/klepp-2002.toml --set F_20=0 --set mu_1=0.6 --format json
raw klepp-two.csv solve models/klepp-2002.toml --set F_20=0 --set mu_1=0.6 --format csv

# Sweeps; their tables are not kept.
tables=$(mktemp -d)
trap 'rm -r "$tables"' EXIT
sweep() {
    local file=$1 table=$2
    shift 2
    show "$file" 0 sweep "$@" --output "$tables/$table"
    sed -i "1s|--output .*|--output $table|" "$output/$file"
}
sweep sweep-klepp.txt klepp.csv models/klepp-2002.toml --set F_20=0 --vary mu_1=0..0.8:801
sweep sweep-drawer.txt drawer.npz models/drawer.toml --vary "mu=normal(0.6, 0.05)" --samples 100000

# The gallery.
show painleve-klein.txt 0 solve models/painleve-klein.toml
show painleve-klein-none.txt 1 solve models/painleve-klein.toml --set mu=4
show painleve-klein-two.txt 0 solve models/painleve-klein.toml --set mu=4 --set direction=-1
show painleve-klein-ray.txt 0 solve models/painleve-klein.toml --set "mu=2/tan(phi)" --set P_2=0
show drawer.txt 0 solve models/drawer.toml
show drawer-jam.txt 1 solve models/drawer.toml --set mu=0.7
show cam-follower.txt 0 solve models/cam-follower.toml
show cam-follower-jam.txt 1 solve models/cam-follower.toml --set mu=0.9 --set d=0
show bracket-on-pole.txt 2 solve models/bracket-on-pole.toml
show slider-crank.txt 0 solve models/slider-crank.toml
show slider-crank-150.txt 0 solve models/slider-crank.toml --at "phi=150 deg"
show scotch-yoke.txt 0 solve models/scotch-yoke.toml
show elliptic-trammel.txt 0 solve models/elliptic-trammel.toml
show sleeve-on-arm.txt 0 solve models/sleeve-on-arm.toml
show telescopic-boom.txt 0 solve models/telescopic-boom.toml
show klepp-2002-spring.txt 0 solve models/klepp-2002-spring.toml
show frictional-oscillator.txt 0 solve models/frictional-oscillator.toml
show stick-slip.txt 0 solve models/stick-slip.toml
show thrown-drawer.txt 0 solve models/thrown-drawer.toml
show stribeck-belt.txt 0 solve models/stribeck-belt.toml
show soft-closing-drawer.txt 0 solve models/soft-closing-drawer.toml --at "x=-50 mm"

# The command line.
show help.txt 0 --help
show help-solve.txt 0 solve --help
show help-limits.txt 0 limits --help
show help-map.txt 0 map --help
show help-modes.txt 0 modes --help
show help-sweep.txt 0 sweep --help
show check-klepp.txt 0 check models/klepp-2002.toml
show check-bracket.txt 2 check models/bracket-on-pole.toml
show models.txt 0 models

# The guide.
show my-drawer.txt 0 solve $examples/my-drawer.toml
show mistakes.txt 2 solve $examples/mistakes.toml
show setting-mistakes.txt 2 solve models/drawer.toml --set "L=3 kg" --set nu=0.7
show at-rest.txt 2 solve models/drawer.toml --rate x=0
show guided-tips.txt 1 solve $examples/guided-tips.toml
show block-tips.txt 0 solve $examples/block-tips.toml

# Standstill.
show help-hold.txt 0 hold --help
show hold-bracket.txt 0 hold models/bracket-on-pole.toml --load W --vary mu_static
show hold-bracket-near.txt 1 hold models/bracket-on-pole.toml --load W --set "x=200 mm"
show hold-klepp.txt 0 hold models/klepp-2002.toml --set F_20=0 --set mu_1=0.3 --set "P=0.05*m*g"
show hold-boom.txt 1 hold models/telescopic-boom.toml
show hold-both.txt 0 hold models/painleve-klein.toml --set mu=4 --set "P_1=12 N"
show hold-neither.txt 1 hold $examples/guided-tips.toml
show hold-cam.txt 1 hold models/cam-follower.toml --load cam

# Motion.
show help-simulate.txt 0 simulate --help
show simulate-oscillator.txt 0 simulate models/frictional-oscillator.toml --until 3s
show simulate-stick-slip.txt 0 simulate models/stick-slip.toml --until 2s
show simulate-stribeck-belt.txt 0 simulate models/stribeck-belt.toml --until 2s
show simulate-soft-closing-drawer.txt 0 simulate models/soft-closing-drawer.toml --until 1s
show simulate-drawer-jam.txt 0 simulate models/thrown-drawer.toml --until 0.6s
show simulate-drawer-stop.txt 0 simulate models/thrown-drawer.toml --until 0.6s --set "x_s=0.2 m"
show simulate-drawer-locks.txt 0 simulate models/thrown-drawer.toml --until 0.6s --set "x_s=0.255 m"
show limits-drawer-thrown.txt 0 limits models/thrown-drawer.toml --vary "x=0 m..0.39 m"
show simulate-crank.txt 0 simulate models/slider-crank.toml --until 30ms
show simulate-trammel.txt 0 simulate models/elliptic-trammel.toml --until 1.2s
show simulate-sleeve.txt 0 simulate models/sleeve-on-arm.toml --until 0.6s
show simulate-boom.txt 0 simulate models/telescopic-boom.toml --until 0.6s
show simulate-klepp.txt 0 simulate models/klepp-2002-spring.toml --until 1s
show simulate-klepp-locked.txt 0 simulate models/klepp-2002-spring.toml --until 10s --set mu_1=0.6 --prefer sliding
show simulate-klepp-jam.txt 0 simulate models/klepp-2002-spring.toml --until 10s --set mu_1=0.6 --set direction=-1
show simulate-branches.txt 0 simulate models/klepp-2002-spring.toml --until 0.1s --set mu_1=0.6 --all-branches
show simulate-contradiction.txt 2 simulate models/klepp-2002-spring.toml --until 1s --set mu_1=0.6 --mode "- - -"

# Design.
show help-size.txt 0 size --help
show help-drive.txt 0 drive --help
show size-drawer.txt 0 size models/drawer.toml --vary L --margin 2
show size-cam.txt 0 size models/cam-follower.toml --vary "phi=10 deg..80 deg" --margin 2
show size-bracket.txt 0 size models/bracket-on-pole.toml --vary x --margin 1.5 --against hold --load W
show drive-drawer.txt 0 drive models/drawer.toml --vary mu
show drive-cam.txt 0 drive models/cam-follower.toml
show drive-wedge.txt 0 drive models/wedge.toml --vary alpha="5 deg..80 deg"
show drive-screw.txt 0 drive models/screw.toml --vary mu=0..0.3
show drive-press.txt 0 drive $examples/press.toml --vary "angle=5 deg..89 deg"
show drive-engine.txt 0 drive $examples/engine.toml --vary "angle=-40 deg..100 deg"
show screw.txt 0 solve models/screw.toml
show wedge.txt 0 solve models/wedge.toml

# Problems given by matrices.
show modes-species.txt 0 modes $examples/species.json
show modes-ave.txt 0 modes $examples/ave.json
show modes-ray.txt 0 modes crates/slideway-cli/tests/raw/good/ray.json
show modes-mistakes.txt 2 modes $examples/problem-mistakes.json
