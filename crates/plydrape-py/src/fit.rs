//! `plydrape.fit`.

use crate::error;
use crate::json::Json;
use crate::quantity::Amount;
use plydrape_io::fit::{Request, Test};
use plydrape_io::scene::{Measured, usual};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::PathBuf;

/// Fits laws of a material to tables of its tests, as `plydrape fit` does.
///
/// Plain numbers are in SI units, a str carries its unit.
///
/// Parameters
/// ----------
/// test : {"bias", "rate", "frame", "overhang", "hang", "moments"}
///     What was tested; "rate" is bias extension with a column of the time.
/// warp : sequence of str or path
///     CSV files, one a specimen: of a shear test, or of strips along the warp.
/// weft : sequence of str or path
///     CSV files of strips along the weft.
/// width : float or str, optional
///     Width of bias-extension specimens (m).
/// length : float or str, optional
///     Length between the clamps, or of the overhang of hanging strips (m).
/// side : float or str, optional
///     Side of the picture frame (m).
/// fabric : float or str, optional
///     Side of the fabric that shears in it (m).
/// mass : float or str, optional
///     Mass per area (kg/m²).
/// angle : float or str, default "41.5 deg"
///     Angle of the chord of overhangs (rad).
/// displacement, force : str, optional
///     Titles of the columns of a shear test, where they have other names than usual.
/// overhang : str, optional
///     Title of the column of overhangs.
/// x, z : str, optional
///     Titles of the columns of points of a hanging strip.
/// curvature, moment : str, optional
///     Titles of the columns of a bending test.
///
/// What a file states of its own specimen is used for its rows; the measures that are given here are those of files that state none.
///
/// Returns
/// -------
/// dict
///     What was fitted, with standard errors and 95 % intervals, `notes` of what the files show beside it, and `toml`, the lines of a
///     material file.
///
/// Raises
/// ------
/// SceneError
///     If a table is broken, states no measure that is not given either, or shows what no specimen does.
/// ValueError
///     If the points say no law.
///
/// Examples
/// --------
/// >>> from pathlib import Path
/// >>> from tempfile import mkdtemp
/// >>> file = Path(mkdtemp()) / "strips.csv"
/// >>> _ = file.write_text("overhang (mm)\n61.5\n63\n60.5\n62.5\n62.5\n")
/// >>> found = plydrape.fit("overhang", [file], mass="314 g/m^2")
/// >>> 'bending_rigidity_warp = "9.178e-5 N m"' in found["toml"]
/// True
#[pyfunction]
#[pyo3(signature = (
    test, warp = Vec::new(), weft = Vec::new(), *, width: "float | str | None" = None,
    length: "float | str | None" = None, side: "float | str | None" = None,
    fabric: "float | str | None" = None, mass: "float | str | None" = None,
    angle: "float | str" = Amount::Text("41.5 deg".into()), displacement: "str | None" = None,
    force: "str | None" = None, overhang: "str | None" = None, x: "str | None" = None,
    z: "str | None" = None, curvature: "str | None" = None, moment: "str | None" = None
))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn fit(
    test: &str,
    warp: Vec<PathBuf>,
    weft: Vec<PathBuf>,
    width: Option<Amount>,
    length: Option<Amount>,
    side: Option<Amount>,
    fabric: Option<Amount>,
    mass: Option<Amount>,
    angle: Amount,
    displacement: Option<String>,
    force: Option<String>,
    overhang: Option<String>,
    x: Option<String>,
    z: Option<String>,
    curvature: Option<String>,
    moment: Option<String>,
) -> PyResult<Json> {
    // all measures in SI units; those that a table states itself may be left out
    let length_of =
        |length, name| Amount::given(length, name, Measured::Length, &usual::Coupon::USUAL);
    let (width, length) = (length_of(width, "width")?, length_of(length, "length")?);
    let (side, fabric) = (length_of(side, "side")?, length_of(fabric, "fabric")?);
    let mass = Amount::given(mass, "mass", Measured::ArealMass, &usual::PlyMass::USUAL)?;
    let angle = angle.si("angle", Measured::Angle, &usual::AnyAngle::USUAL)?;

    // each test has its own measures and its own columns
    let (test, titles) = match test {
        "bias" => (Test::Bias { width, length }, [displacement, force]),
        "rate" => (Test::Rate { width, length }, [displacement, force]),
        "frame" => (Test::Frame { side, fabric }, [displacement, force]),
        "overhang" => (Test::Overhang { mass, angle }, [overhang, None]),
        "hang" => (Test::Hang { mass, length }, [x, z]),
        "moments" => (Test::Moments, [curvature, moment]),
        other => {
            return Err(PyValueError::new_err(format!(
                "test is {other:?}; expected bias, rate, frame, overhang, hang or moments"
            )));
        }
    };

    // the same fit as that of the command line
    let fitted = plydrape_io::fit::fit(&Request { test, warp, weft, titles })
        .map_err(|fault| error::value(&fault))?;
    Json::new(&fitted.json())
}
