"""From a mold to a planned motion: 2 × 2 grippers lay a prepreg on a dome.

The same in Rust is `crates/plydrape/examples/dome.rs`.
"""

import plydrape

# 314 g/m², held at the corners of 100 mm, on a dome of 1 m radius whose top is the origin
prepreg = {
    "name": "prepreg",
    "mass": "0.3143 kg/m^2",
    "bending_rigidity_warp": "9e-5 N m",
    "bending_rigidity_weft": "9e-5 N m",
    "tension": "1e6 N/m",
    "shear_curve": "5 N/m",
}
scene = plydrape.Scene(
    ply={"grippers": [2, 2], "cell": ["100 mm", "100 mm"], "material": prepreg},
    mold={"kind": "sphere", "radius": "1 m", "position": [0, 0, "-1 m"]},
    target={"seed": "middle"},
    limits={"height": "0.5 mm"},
)

# the motion, judged by the whole ply as a sheet
plan = plydrape.plan(scene, without_errors=True)
print(f"{plan.duration:.1f} s, accepted: {str(plan.accepted).lower()}")
for limit in plan.result.limits.values():
    print(f"  {limit.label}: {limit.value:.2f} {limit.unit}")
