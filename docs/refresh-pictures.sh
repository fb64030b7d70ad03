#!/usr/bin/env bash
# Regenerates every picture of the book and the README, by running the program.
#
#   cargo build --release && docs/refresh-pictures.sh
#
# SLIDEWAY=path runs another binary. The same program makes the same bytes.
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

draw klepp-2002.svg models/klepp-2002.toml
draw klepp-2002-dark.svg models/klepp-2002.toml --theme dark
draw klepp-2002-mechanism.svg models/klepp-2002.toml --solution none
draw klepp-2002-second.svg models/klepp-2002.toml --solution 2
draw painleve-klein-two.svg models/painleve-klein.toml --set mu=4 --set direction=-1
draw slider-crank-tipped.svg models/slider-crank.toml --set mu=0.8 --at "phi=150 deg"
draw sleeve-on-arm.svg models/sleeve-on-arm.toml
draw telescopic-boom.svg models/telescopic-boom.toml
