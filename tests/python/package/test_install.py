"""The package installs as users install it, into a clean environment, with NumPy alone."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]

DRAPE = """
import sys
from pathlib import Path
import plydrape, plydrape.cad

examples = Path(sys.argv[1]) / "examples"
result = plydrape.simulate(plydrape.Scene.read(examples / "01_flat_sheared_mold" / "scene.toml"))
print(result.model, result.first_contact_step)
Path("mold.step").write_text("ISO-10303-21;")
for use in (
    lambda: result.plot(),
    lambda: result.to_pyvista(),
    lambda: plydrape.study.run(examples / "study" / "study.toml"),
    lambda: plydrape.cad.read("mold.step"),
):
    try:
        use()
    except plydrape.ExtraError as error:
        print(error)
"""


def test_the_wheel_installs_with_numpy_alone(tmp_path: Path) -> None:
    """It drapes an example; what needs more says what to install."""
    wheels = sorted((ROOT / "build" / "wheels").glob("plydrape-*-cp310-abi3-*.whl"))
    assert len(wheels) == 1, "scripts/package makes one wheel for every Python from 3.10 on"
    # the pip that runs here installs into it: to bring it one of its own takes longer than all else
    empty = [sys.executable, "-m", "venv", "--without-pip", str(tmp_path / "clean")]
    subprocess.run(empty, check=True)
    python = str(tmp_path / "clean" / "bin" / "python")
    pip = [sys.executable, "-m", "pip", "--python", python]
    pip += ["--disable-pip-version-check", "--no-input"]
    subprocess.run([*pip, "install", "--quiet", "--no-compile", str(wheels[0])], check=True)
    listed = subprocess.run(
        [*pip, "list", "--format", "freeze"], check=True, capture_output=True, text=True
    )
    names = {line.partition("==")[0].partition(" ")[0] for line in listed.stdout.splitlines()}
    assert names == {"numpy", "plydrape"}, listed.stdout
    command = [python, "-c", DRAPE, str(ROOT)]
    done = subprocess.run(command, check=True, capture_output=True, text=True, cwd=tmp_path)
    first, *others = done.stdout.splitlines()
    assert first == "sheet 22"
    wanted = [line.partition("pip install ")[2] for line in others]
    assert wanted[:2] == ["matplotlib", "pyvista"], others
    assert wanted[2:] == ["scipy pyarrow pandas", "cadquery-ocp-novtk"], others
    installed = {path.name for path in (tmp_path / "clean").rglob("plydrape/*")}
    assert {"py.typed", "_plydrape.pyi"} <= installed
