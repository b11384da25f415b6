"""The package installs as a user installs it, into a clean environment, with NumPy and nothing else."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]

DRAPE = """
import plydrape, plydrape.cad, plydrape.study
scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
print(plydrape.simulate(scene).summary["first_contact_step"])
for extra, use in [("plot", lambda r: r.plot()), ("plot", lambda r: r.scene3d()),
                   ("study", lambda r: plydrape.study.run("examples/study/study.toml")),
                   ("cad", lambda r: plydrape.cad.read("mold.step"))]:
    try:
        use(plydrape.simulate(scene))
    except ImportError as error:
        print(extra, f"plydrape[{extra}]" in str(error))
"""


def test_pip_installs_it_with_numpy_alone(tmp_path: Path) -> None:
    """It drapes an example; what needs more says by which extra it comes."""
    subprocess.run([sys.executable, "-m", "venv", str(tmp_path / "clean")], check=True)
    python = str(tmp_path / "clean" / "bin" / "python")
    pip = [python, "-m", "pip", "--disable-pip-version-check", "--no-input"]
    subprocess.run([*pip, "install", "--quiet", str(ROOT)], check=True)
    listed = subprocess.run(
        [*pip, "list", "--format", "freeze"], check=True, capture_output=True, text=True
    )
    names = {line.partition("==")[0].partition(" ")[0] for line in listed.stdout.splitlines()}
    assert names - {"pip", "setuptools", "wheel"} == {"numpy", "plydrape"}, listed.stdout
    done = subprocess.run(
        [python, "-c", DRAPE], check=True, capture_output=True, text=True, cwd=ROOT
    )
    assert done.stdout.split("\n") == ["26", "plot True", "plot True", "study True", "cad True", ""]
    installed = {path.name for path in (tmp_path / "clean").rglob("plydrape/*")}
    assert {"py.typed", "_plydrape.pyi"} <= installed
