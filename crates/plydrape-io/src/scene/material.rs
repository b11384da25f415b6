//! A material by name, by file or in place.

use super::check::line;
use super::choice::MaterialChoice;
use super::error::{Document, SceneError, excerpt};
use super::file::{MaterialTable, ShearCurveTable};
use super::located::Located;
use super::quantity::{Measure, Quantity};
use super::read;
use super::units::Dimension;
use crate::shown;
use plydrape::material::{Material, Section, ShearCurve};
use std::ops::Range;
use std::path::Path;

/// The materials that come with the program: name and file.
const SHIPPED: [(&str, &str); 2] = [
    ("krogh2018", include_str!("../../materials/krogh2018.toml")),
    ("cao2008_plain", include_str!("../../materials/cao2008_plain.toml")),
];

/// Smallest and largest mass per length (kg/m) or area (kg/m²).
const MASSES: [f64; 2] = [1e-6, 1e3];
/// Largest flexural rigidity (N·m²) or rigidity per width (N·m).
const RIGIDITY: f64 = 1e6;

/// Names of the materials that come with the program.
pub fn shipped_materials() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|(name, _)| *name)
}

/// The file of a material that comes with the program, by its name.
#[must_use]
pub fn shipped_material(name: &str) -> Option<&'static str> {
    SHIPPED.iter().find(|(shipped, _)| *shipped == name).map(|(_, text)| *text)
}

/// The material that a scene chose; files are relative to `base`.
pub(super) fn material(
    choice: &Located<MaterialChoice>,
    document: &Document,
    base: &Path,
) -> Result<Material, SceneError> {
    match &choice.value {
        MaterialChoice::Table(table) => from_table(table, document, &choice.span, "inline"),
        MaterialChoice::Named(name) => named(name, &choice.span, document, base),
    }
}

fn named(
    name: &str,
    span: &Range<usize>,
    scene: &Document,
    base: &Path,
) -> Result<Material, SceneError> {
    // A shipped name.
    if let Some(text) = shipped_material(name) {
        let document = Document::new(format!("materials/{name}.toml"), text);
        return from_file(&document, name);
    }
    if !name.ends_with(".toml") {
        let shipped: Vec<_> = shipped_materials().map(|n| format!("\"{n}\"")).collect();
        return Err(scene.error(
            span.clone(),
            format!("there is no material \"{}\"", excerpt(name)),
            format!(
                "plydrape comes with {}; a file of your own is named with its ending, e.g. \"mine.toml\"",
                shipped.join(", ")
            ),
        ));
    }

    // A file beside the scene.
    let path = base.join(name);
    let document = read::text(&path, name, read::LARGEST_TOML).map_err(|error| {
        if error.span.is_some() {
            return error;
        }
        let help = format!("paths are relative to the scene's folder; {}", error.help);
        scene.error(span.clone(), error.message, help)
    })?;
    if document.text == scene.text {
        return Err(scene.error(
            span.clone(),
            format!("the scene names itself, \"{name}\", as its material"),
            "name a file with mass and rigidity, or a shipped material such as \"krogh2018\"",
        ));
    }
    let stem = Path::new(name).file_stem().unwrap_or_default();
    from_file(&document, &stem.to_string_lossy())
}

fn from_file(document: &Document, name: &str) -> Result<Material, SceneError> {
    let table: MaterialTable = read::keys(document)?;
    if table.source.is_none() {
        let first_line = document.text.find('\n').unwrap_or(document.text.len());
        return Err(document.error(
            0..first_line,
            format!("the material file `{}` has no `source`", document.file),
            "say where the numbers come from: source = \"measured by …, 2026\"",
        ));
    }
    from_table(&table, document, &(0..0), name)
}

/// Checks the keys of a material; `place` is the table's span, `name` stands in for a missing one.
fn from_table(
    table: &MaterialTable,
    document: &Document,
    place: &Range<usize>,
    name: &str,
) -> Result<Material, SceneError> {
    let shear_curve = match &table.shear_curve {
        Some(curve) => Some(shear_curve(curve, document)?),
        None => None,
    };
    let text_of =
        |text: &Option<Located<String>>| text.as_ref().map(|text| line(text, document)).transpose();
    let mut source = text_of(&table.source)?.unwrap_or_else(|| "stated in the scene".into());
    let locking_angle = match (&table.locking_angle, &table.locking_test) {
        (Some(angle), Some(test)) => {
            let test = line(test, document)?;
            source = format!("{source}; locking angle: {test}");
            angle.positive(document)?;
            Some(angle.below_right_angle(document)?)
        }
        (Some(angle), None) => {
            return Err(document.error(
                angle.span.clone(),
                "the locking angle does not say which test found it",
                "add locking_test = \"picture frame\" or the like",
            ));
        }
        (None, _) => None,
    };
    Ok(Material {
        name: text_of(&table.name)?.unwrap_or_else(|| shown::name(name)),
        source,
        section: section(table, document, place)?,
        shear_curve,
        tension: None,
        locking_angle,
    })
}

/// Mass and rigidity: both by line, or both by area.
fn section(
    table: &MaterialTable,
    document: &Document,
    place: &Range<usize>,
) -> Result<Section, SceneError> {
    let (_, dimension) = table.mass.with_dimension(document)?;
    let mass = table.mass.within(document, MASSES)?;
    let by_area = table.bending_rigidity_warp.is_some() || table.bending_rigidity_weft.is_some();
    let mismatch = |rigidity: &str| {
        document.error(
            table.mass.span.clone(),
            format!("{} does not go with `{rigidity}`", document.quoted(&table.mass.span)),
            "a mass per length (kg/m) goes with `flexural_rigidity` (N m^2), a mass per area (kg/m^2) with `bending_rigidity_warp` and `_weft` (N m)",
        )
    };
    match (
        &table.flexural_rigidity,
        &table.bending_rigidity_warp,
        &table.bending_rigidity_weft,
    ) {
        (Some(_), None, None) if dimension == Some(Dimension::AREAL_MASS) => {
            Err(mismatch("flexural_rigidity"))
        }
        (Some(rigidity), None, None) => Ok(Section::Line {
            mass,
            flexural_rigidity: bounded_rigidity(rigidity, document)?,
        }),
        (None, ..) if by_area && dimension == Some(Dimension::LINE_MASS) => {
            Err(mismatch("bending_rigidity_warp"))
        }
        (None, Some(warp), Some(weft)) => Ok(Section::Areal {
            mass,
            warp_rigidity: bounded_rigidity(warp, document)?,
            weft_rigidity: bounded_rigidity(weft, document)?,
        }),
        (Some(rigidity), ..) => Err(document.error(
            rigidity.span.clone(),
            "the material has a `flexural_rigidity` and a `bending_rigidity`",
            "keep `flexural_rigidity` with a mass per length, or both `bending_rigidity_warp` and `_weft` with a mass per area",
        )),
        (None, Some(one), None) | (None, None, Some(one)) => Err(document.error(
            one.span.clone(),
            "the bending rigidity is given in one direction only",
            "give both `bending_rigidity_warp` and `bending_rigidity_weft`",
        )),
        (None, None, None) => Err(document.error(
            if place.is_empty() { table.mass.span.clone() } else { place.clone() },
            "the material has no rigidity",
            "add flexural_rigidity = \"9e-6 N m^2\" to a mass per length, or bending_rigidity_warp and _weft = \"2e-4 N m\" to a mass per area; 0 is a limp ply",
        )),
    }
}

fn bounded_rigidity<M: Measure>(
    rigidity: &Quantity<M>,
    document: &Document,
) -> Result<f64, SceneError> {
    let value = rigidity.not_negative(document)?;
    if value == 0.0 {
        return Ok(value);
    }
    rigidity.within(document, [f64::MIN_POSITIVE, RIGIDITY])
}

/// A measured table, or a polynomial.
fn shear_curve(
    curve: &Located<ShearCurveTable>,
    document: &Document,
) -> Result<ShearCurve, SceneError> {
    let table = &curve.value;
    match (&table.angle, &table.force, &table.polynomial) {
        (Some(angle), Some(force), None) => {
            if angle.value.len() != force.value.len() || angle.value.len() < 2 {
                return Err(document.error(
                    force.span.clone(),
                    format!(
                        "the shear curve has {} angles and {} forces",
                        angle.value.len(),
                        force.value.len()
                    ),
                    "give as many forces as angles, two or more",
                ));
            }
            Ok(ShearCurve::Table {
                angle: ascending_angles(&angle.value, document)?,
                force: rising_forces(&force.value, document)?,
            })
        }
        (None, None, Some(polynomial)) => {
            let mut coefficients = Vec::with_capacity(polynomial.value.len());
            for coefficient in &polynomial.value {
                coefficients.push(coefficient.si(document)?);
            }
            let curve = ShearCurve::Polynomial { coefficients };
            let force = |degree: i32| curve.force(f64::from(degree).to_radians()).0;
            match (1..=60).find(|degree| force(*degree) < 0.0 || !force(*degree).is_finite()) {
                None => Ok(curve),
                Some(degree) => Err(document.error(
                    polynomial.span.clone(),
                    format!("the shear force is negative or infinite at {degree} deg"),
                    "give coefficients of γ, γ², … in N/m, γ in rad, with a force of zero or more up to 60 deg",
                )),
            }
        }
        _ => Err(document.error(
            curve.span.clone(),
            "the shear curve is neither a table nor a polynomial",
            "give `angle` and `force`, or `polynomial`, and not both",
        )),
    }
}

fn ascending_angles<M: Measure>(
    angles: &[Quantity<M>],
    document: &Document,
) -> Result<Vec<f64>, SceneError> {
    let mut values: Vec<f64> = Vec::with_capacity(angles.len());
    for angle in angles {
        let value = angle.not_negative(document)?;
        let fault = match values.last() {
            None if value > 0.0 => "the shear curve does not start at an angle of 0",
            Some(last) if value <= *last => "the angles of the shear curve do not ascend",
            _ if value >= std::f64::consts::FRAC_PI_2 => {
                "the shear curve reaches a right angle or more"
            }
            _ => {
                values.push(value);
                continue;
            }
        };
        return Err(document.error(
            angle.span.clone(),
            fault,
            "give angles ascending from 0 to below 90 deg, as in [0, \"10 deg\", \"20 deg\"]",
        ));
    }
    Ok(values)
}

fn rising_forces<M: Measure>(
    forces: &[Quantity<M>],
    document: &Document,
) -> Result<Vec<f64>, SceneError> {
    let mut values: Vec<f64> = Vec::with_capacity(forces.len());
    for force in forces {
        let value = force.not_negative(document)?;
        if value > RIGIDITY {
            return Err(document.error(
                force.span.clone(),
                format!("{} is too large for a ply", document.quoted(&force.span)),
                "a shear force per length up to 1e6 N/m is wanted",
            ));
        }
        if values.last().is_some_and(|last| value < *last) {
            return Err(document.error(
                force.span.clone(),
                "the force of the shear curve falls here",
                "give forces that never fall: where a test shows less force, the cloth slipped or wrinkled, and the curve ends before",
            ));
        }
        values.push(value);
    }
    Ok(values)
}
