"""The peer of the sheet in finite elements: motions of scenes, draped by NGSolve.

For each scene it simulates, exports to NGSolve, runs the script that the export wrote, and prints
what ``plydrape compare`` says. One drape takes minutes to hours of one core, by the mesh.

    python benches/peers/ngsolve.py examples/01_flat_sheared_mold/scene.toml --mesh "25 mm"

Options after ``--`` go to the script, such as ``-- --step 5e-3 --longest 3``. The binary is
$PLYDRAPE, or else the release build.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    """Drapes the scenes one after the other."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("scenes", nargs="+", type=Path, metavar="SCENE")
    parser.add_argument("--mesh", help="largest side of a quad, as in '10 mm'")
    parser.add_argument("--json", action="store_true", help="print JSON instead of tables")
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    args, script = parser.parse_args(sys.argv[1:split]), sys.argv[split + 1 :]
    plydrape = os.environ.get("PLYDRAPE", str(ROOT / "target" / "release" / "plydrape"))
    mesh = ["--mesh", args.mesh] if args.mesh else []
    one_thread = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    for scene in args.scenes:
        with tempfile.TemporaryDirectory() as home:
            result, folder = Path(home) / "run", Path(home) / "ngsolve"
            simulated = subprocess.run(
                [plydrape, "simulate", str(scene), "-o", str(result), "--quiet"], check=False
            )
            # a motion that is not accepted is draped too
            if simulated.returncode > 1:
                raise SystemExit(simulated.returncode)
            export = [plydrape, "export", str(result), "--to", "ngsolve", "-o", str(folder)]
            subprocess.run([*export, *mesh, "--quiet"], check=True)
            drape = [sys.executable, str(folder / "drape.py"), *script]
            subprocess.run(drape, check=True, env=one_thread, stdout=sys.stderr)
            shown = ["--json"] if args.json else []
            subprocess.run([plydrape, "compare", str(result), str(folder), *shown], check=True)


if __name__ == "__main__":
    main()
