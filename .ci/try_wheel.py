#!/usr/bin/env python3
"""Asks the installed package slideway, and fails if it does not answer as it should.

    python .ci/try_wheel.py
"""

import slideway

drawer = slideway.Model.gallery("drawer")
answer = drawer.solve()
print(answer)
# docs/src/gallery.md derives that no push moves the drawer from mu = L/(2 a) = 2/3 on: seven of these eleven values
# are below.
assert answer.status == "one"
assert drawer.with_(mu=1.2).solve().status == "none"
assert drawer.sweep(mu="0..1:11").to_numpy()["solutions"].sum() == 7
assert drawer.draw(1).svg.startswith("<svg")
