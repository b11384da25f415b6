//! `plydrape.Ply` and `plydrape.Material`.

use crate::arrays::{Array, Numbers};
use crate::{error, table};
use plydrape::material::{self, Section, Spread};
use plydrape::ply::{self, Direction};
use plydrape_io::scene;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::BTreeMap;
use std::path::PathBuf;
use toml::Value;
use toml::map::Map;

/// A share, or a factor by its key.
#[derive(IntoPyObject)]
enum ScatterValue {
    /// Standard deviation as a share of the value.
    Share(f64),
    /// `{"factor": f}`.
    Factor(BTreeMap<&'static str, f64>),
}

impl From<Spread> for ScatterValue {
    fn from(spread: Spread) -> Self {
        match spread {
            Spread::Share(share) => ScatterValue::Share(share),
            Spread::Factor { factor } => ScatterValue::Factor([("factor", factor)].into()),
        }
    }
}

/// A woven ply held by grippers: a rectangle held by an array of them, or, from a scene, as it is cut.
///
/// Grippers are counted with i, along u, running fastest. Catenaries are counted: edges along u, edges along
/// v, then two diagonals a cell, the one from `[i, j]` to `[i + 1, j + 1]` first.
///
/// Parameters
/// ----------
/// grippers : sequence of int
///     How many there are along u and v; `[n, 1]` is a strip.
/// cell : sequence of float or str
///     Fabric length between neighbors along u and v, in m or as str with a unit.
/// material : str or dict
///     Name of a shipped material, path of a .toml file, or a dict of its keys.
/// warp : str, default "u"
///     Grid direction of the warp, "u" or "v".
/// base : str or path, optional
///     Folder of a material file.
///
/// Raises
/// ------
/// SceneError
///     If a value makes no sense.
///
/// Examples
/// --------
/// >>> ply = plydrape.Ply(grippers=[4, 2], cell=["100 mm", "100 mm"], material="krogh2018")
/// >>> len(ply.catenaries)
/// 16
#[pyclass(frozen, module = "plydrape")]
#[derive(Clone)]
pub struct Ply(pub ply::Ply);

#[pymethods]
impl Ply {
    #[new]
    #[pyo3(signature = (
        *, grippers: "typing.Sequence[int]", cell: "typing.Sequence[float | str]",
        material: "str | dict[str, typing.Any]", warp = "u", base = PathBuf::new()
    ))]
    fn new(
        py: Python<'_>,
        grippers: &Bound<'_, PyAny>,
        cell: &Bound<'_, PyAny>,
        material: &Bound<'_, PyAny>,
        warp: &str,
        base: PathBuf,
    ) -> PyResult<Self> {
        let keys = PyDict::new(py);
        keys.set_item("grippers", grippers)?;
        keys.set_item("cell", cell)?;
        keys.set_item("material", material)?;
        keys.set_item("warp", warp)?;
        let mut file = Map::new();
        file.insert("ply".into(), Value::Table(table::table(&keys, "ply")?));
        let ply = scene::parse_ply(&table::text(&file)?, &base, "ply");
        ply.map(Ply).map_err(|refused| error::scene(&refused))
    }

    /// Grippers along u and v; zeros where they are no whole array along the yarns.
    #[getter]
    fn grippers(&self) -> (usize, usize) {
        (self.0.grid.nu, self.0.grid.nv)
    }

    /// Fabric length of a cell along u and v (m).
    #[getter]
    fn cell(&self) -> (f64, f64) {
        self.0.cell.into()
    }

    /// What it is made of.
    #[getter]
    fn material(&self) -> Material {
        Material(self.0.material.clone())
    }

    /// Grid direction of the warp: "u" or "v".
    #[getter]
    fn warp(&self) -> &'static str {
        match self.0.warp {
            Direction::U => "u",
            Direction::V => "v",
        }
    }

    /// Grippers at the ends of each catenary, shape (catenaries, 2).
    #[getter]
    fn catenaries(&self) -> Array<i64> {
        let lines = self.0.lines();
        let ends = (0..lines.catenaries()).map(|n| lines.ends(n).map(|gripper| gripper as i64));
        Array::rows(&[lines.catenaries(), 2], ends)
    }

    /// Fabric length of each catenary of the flat ply (m), shape (catenaries,).
    #[getter]
    fn lengths(&self) -> Array<f64> {
        let lines = self.0.lines();
        let length = |n| lines.flat_length(n, self.0.length_factor);
        Array::new(&[lines.catenaries()], (0..lines.catenaries()).map(length).collect())
    }

    /// Fabric coordinates u, v of each gripper (m), shape (grippers, 2), in the order of all arrays of grippers.
    #[getter]
    fn places(&self) -> Array<f64> {
        let count = self.0.grippers();
        Array::rows(&[count, 2], (0..count).map(|n| self.0.place(n)))
    }

    /// Indices i, j of each gripper, which are its name in files and pages, shape (grippers, 2).
    #[getter]
    fn ids(&self) -> Array<i64> {
        let count = self.0.grippers();
        Array::rows(&[count, 2], (0..count).map(|n| self.0.id(n).map(|k| k as i64)))
    }

    /// Outline of a ply that is cut, fabric coordinates (m), shape (points, 2), counterclockwise; None of one that ends at its
    /// grippers or a margin beyond them.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/13_cut_ply/scene.toml")
    /// >>> scene.ply.outline.shape, len(scene.ply.holes), len(scene.ply.places)
    /// ((5, 2), 1, 15)
    #[getter]
    fn outline(&self) -> Option<Array<f64>> {
        Some(ring(self.0.cut.as_ref()?.outline.boundary()))
    }

    /// Holes of a ply that is cut, each as `outline`, clockwise.
    #[getter]
    fn holes(&self) -> Vec<Array<f64>> {
        let cut = self.0.cut.iter();
        cut.flat_map(|cut| cut.outline.holes()).map(|hole| ring(hole)).collect()
    }

    fn __repr__(&self) -> String {
        let ply = &self.0;
        let [a, b] = ply.cell.map(|side| side * 1e3);
        let (grid, name) = (ply.grid, &ply.material.name);
        if ply.cut.is_some() {
            let count = ply.grippers();
            return format!("<plydrape.Ply cut to an outline, {count} grippers, {name:?}>");
        }
        format!(
            "<plydrape.Ply {} × {} grippers, cells of {a} × {b} mm, {name:?}>",
            grid.nu, grid.nv
        )
    }
}

fn ring(points: &[[f64; 2]]) -> Array<f64> {
    Array::rows(&[points.len(), 2], points.iter().copied())
}

/// What a ply is made of: mass, flexural rigidity, tension, shear curve and locking angle.
///
/// Examples
/// --------
/// >>> material = plydrape.Material.shipped("krogh2018")
/// >>> material.mass, material.flexural_rigidity
/// (0.3143, 9e-06)
#[pyclass(frozen, module = "plydrape")]
#[derive(Clone)]
pub struct Material(pub material::Material);

#[pymethods]
impl Material {
    /// A material that comes with plydrape, see `materials`.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Its name.
    ///
    /// Returns
    /// -------
    /// Material
    ///     The material.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such name.
    ///
    /// Examples
    /// --------
    /// >>> plydrape.Material.shipped("krogh2018").name
    /// 'krogh2018'
    #[staticmethod]
    fn shipped(name: &str) -> PyResult<Self> {
        Material::text(name)?;
        let scene = format!("[ply]\ngrippers = [2, 1]\ncell = [1, 1]\nmaterial = {name:?}\n");
        let ply = scene::parse_ply(&scene, "".as_ref(), name);
        ply.map(|ply| Material(ply.material)).map_err(|refused| error::scene(&refused))
    }

    /// The file of a material that comes with plydrape: TOML.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Its name.
    ///
    /// Returns
    /// -------
    /// str
    ///     The text of the file.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such name.
    ///
    /// Examples
    /// --------
    /// >>> "source" in plydrape.Material.text("krogh2018")
    /// True
    #[staticmethod]
    fn text(name: &str) -> PyResult<&'static str> {
        scene::shipped_material(name).ok_or_else(|| {
            let names: Vec<_> = scene::shipped_materials().collect();
            PyValueError::new_err(format!(
                "there is no material {name:?}; plydrape comes with {}",
                names.join(", ")
            ))
        })
    }

    /// Name for reports.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Where its numbers come from.
    #[getter]
    fn source(&self) -> &str {
        &self.0.source
    }

    /// Whether its numbers are per area; else they belong to each catenary, as in Krogh et al. 2018.
    #[getter]
    fn areal(&self) -> bool {
        matches!(self.0.section, Section::Areal { .. })
    }

    /// Mass per length (kg/m), or per area (kg/m²) if `areal`.
    #[getter]
    fn mass(&self) -> f64 {
        match self.0.section {
            Section::Line { mass, .. } | Section::Areal { mass, .. } => mass,
        }
    }

    /// Flexural rigidity EI of a catenary (N·m²); None if `areal`.
    #[getter]
    fn flexural_rigidity(&self) -> Option<f64> {
        match self.0.section {
            Section::Line { flexural_rigidity, .. } => Some(flexural_rigidity),
            Section::Areal { .. } => None,
        }
    }

    /// Bending rigidity per width along warp and weft (N·m), at rest where the moment is a table; None unless `areal`.
    #[getter]
    fn bending_rigidity(&self) -> Option<(f64, f64)> {
        match self.0.section {
            Section::Line { .. } => None,
            Section::Areal { warp_rigidity, weft_rigidity, .. } => {
                Some((warp_rigidity, weft_rigidity))
            }
        }
    }

    /// Bending moment per width at curvatures, along warp and weft; None unless `areal`.
    ///
    /// Parameters
    /// ----------
    /// curvatures : array_like
    ///     Curvatures (1/m), shape (n,).
    ///
    /// Returns
    /// -------
    /// ndarray or None
    ///     Moments per width (N) along warp and weft, shape (n, 2).
    ///
    /// Examples
    /// --------
    /// >>> bending = {"curvature": [0, 10, 30], "moment": [0, 0.02, 0.04]}
    /// >>> material = {"mass": 0.3, "bending_rigidity_warp": bending, "bending_rigidity_weft": 1e-3}
    /// >>> ply = plydrape.Ply(grippers=[4, 2], cell=[0.1, 0.1], material=material)
    /// >>> ply.material.moment([0, 20])
    /// array([[0.  , 0.  ],
    ///        [0.03, 0.02]])
    fn moment(&self, curvatures: Numbers<'_>) -> PyResult<Option<Array<f64>>> {
        let Some((warp, weft)) = self.bending_rigidity() else { return Ok(None) };
        let curvatures = curvatures.list("curvatures")?;
        let row = |kappa: &f64| {
            let curves = self.0.moment.iter().zip([warp, weft]);
            curves
                .map(|(curve, rigidity)| {
                    curve.as_ref().map_or(rigidity * kappa, |curve| curve.bend(*kappa)[1])
                })
                .collect::<Vec<_>>()
        };
        let moments: Vec<f64> = curvatures.iter().flat_map(row).collect();
        Ok(Some(Array::new(&[curvatures.len(), 2], moments)))
    }

    /// How much its properties scatter between specimens: standard deviations as shares of their values, by the keys of a
    /// material file. That of the shear curve may be a factor f, a dict {"factor": f}: from 1/f to f times the value. Empty where
    /// nothing is said.
    ///
    /// Examples
    /// --------
    /// >>> scatter = {"mass": 0.02, "shear_curve": {"factor": 2}}
    /// >>> material = {"mass": 0.3, "bending_rigidity_warp": 1e-3, "bending_rigidity_weft": 1e-3}
    /// >>> ply = plydrape.Ply(grippers=[4, 2], cell=[0.1, 0.1], material={**material, "scatter": scatter})
    /// >>> ply.material.scatter
    /// {'mass': 0.02, 'shear_curve': {'factor': 2.0}}
    #[getter]
    fn scatter(&self) -> BTreeMap<&'static str, ScatterValue> {
        let scatter = &self.0.scatter;
        let warp = if self.areal() { "bending_rigidity_warp" } else { "flexural_rigidity" };
        [
            ("mass", scatter.mass.map(Spread::Share)),
            (warp, scatter.warp_rigidity.map(Spread::Share)),
            ("bending_rigidity_weft", scatter.weft_rigidity.map(Spread::Share)),
            ("tension", scatter.tension.map(Spread::Share)),
            ("shear_curve", scatter.shear_curve),
        ]
        .into_iter()
        .filter_map(|(key, spread)| Some((key, spread?.into())))
        .collect()
    }

    /// What resin adds to the shear force while the ply is sheared in real time, where it is known: `stiffness` against fast shear
    /// (N/m per rad), `relaxation` (s) at the `temperature` of the ply (K).
    #[getter]
    fn shear_rate(&self) -> Option<BTreeMap<&'static str, f64>> {
        let rate = self.0.shear_rate.as_ref()?;
        let values = [
            ("stiffness", rate.stiffness),
            ("relaxation", rate.time()),
            ("temperature", rate.temperature),
        ];
        Some(values.into_iter().collect())
    }

    /// Shear angle at which the weave locks (rad), where it is known.
    #[getter]
    fn locking_angle(&self) -> Option<f64> {
        self.0.locking_angle
    }

    /// Shear force per length (N/m) at shear angles (rad), shape (n,); None if the material has no shear curve.
    ///
    /// Parameters
    /// ----------
    /// angles : array_like
    ///     Shear angles (rad), of any shape.
    ///
    /// Returns
    /// -------
    /// ndarray or None
    ///     Shear forces per length (N/m), of the same shape.
    ///
    /// Examples
    /// --------
    /// >>> curve = {"angle": [0, "20 deg"], "force": [0, "10 N/m"]}
    /// >>> material = {"mass": 0.3, "flexural_rigidity": 9e-6, "shear_curve": curve}
    /// >>> ply = plydrape.Ply(grippers=[4, 2], cell=[0.1, 0.1], material=material)
    /// >>> ply.material.shear_force(np.deg2rad([0, 10, 20]))
    /// array([ 0.,  5., 10.])
    fn shear_force(&self, angles: Numbers<'_>) -> PyResult<Option<Array<f64>>> {
        let angles = angles.any("angles")?;
        let forces = |curve: &material::ShearCurve| {
            angles.values.iter().map(|angle| curve.force(*angle).0).collect()
        };
        let curve = self.0.shear_curve.as_ref();
        Ok(curve.map(|curve| Array::new(&angles.shape, forces(curve))))
    }

    /// Tension per width (N/m) at strains, shape (n,); None if the material does not say it.
    ///
    /// Parameters
    /// ----------
    /// strains : array_like
    ///     Strains, of any shape.
    ///
    /// Returns
    /// -------
    /// ndarray or None
    ///     Tensions per width (N/m), of the same shape.
    ///
    /// Examples
    /// --------
    /// >>> plydrape.Material.shipped("krogh2018").tension(np.array([0, 0.001]))
    /// array([   0., 1000.])
    fn tension(&self, strains: Numbers<'_>) -> PyResult<Option<Array<f64>>> {
        let strains = strains.any("strains")?;
        let forces = |law: &material::TensionLaw| {
            strains.values.iter().map(|strain| law.tension(*strain)[1]).collect()
        };
        let law = self.0.tension.as_ref();
        Ok(law.map(|law| Array::new(&strains.shape, forces(law))))
    }

    fn __repr__(&self) -> String {
        format!("<plydrape.Material {:?}>", self.0.name)
    }
}
