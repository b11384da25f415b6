//! A material by name, by file or in place.

use super::check::line;
use super::choice::{Curve, MaterialChoice};
use super::file::{FabricKey, MaterialTable, MomentTable};
use super::located::Located;
use super::quantity::{Quantity, Read};
use super::source::{Document, excerpt};
use super::units::Dimension;
use super::usual::{Bending, Factor, LineMass, PlyMass, Share};
use super::{curve, rate, read};
use crate::Error;
use crate::store::shown;
use plydrape::material::{Material, MomentCurve, Scatter, Section, Spread};
use std::ops::Range;
use std::path::Path;

/// The materials that come with the program: name and file.
const SHIPPED: [(&str, &str); 14] = [
    ("krogh2018", include_str!("../../materials/krogh2018.toml")),
    ("dry_carbon", include_str!("../../materials/dry_carbon.toml")),
    ("prepreg_cold", include_str!("../../materials/prepreg_cold.toml")),
    ("prepreg_warm", include_str!("../../materials/prepreg_warm.toml")),
    ("cao2008_plain", include_str!("../../materials/cao2008_plain.toml")),
    ("cao2008_plain_frame", include_str!("../../materials/cao2008_plain_frame.toml")),
    ("broberg2023_binder", include_str!("../../materials/broberg2023_binder.toml")),
    ("broberg2022_strip", include_str!("../../materials/broberg2022_strip.toml")),
    ("petrak2025_polyester_twill", include_str!("../../materials/petrak2025_polyester_twill.toml")),
    ("petrak2025_polyester_light", include_str!("../../materials/petrak2025_polyester_light.toml")),
    ("petrak2025_wool_twill", include_str!("../../materials/petrak2025_wool_twill.toml")),
    ("petrak2025_viscose_twill", include_str!("../../materials/petrak2025_viscose_twill.toml")),
    ("petrak2025_polyester_plain", include_str!("../../materials/petrak2025_polyester_plain.toml")),
    ("petrak2025_cotton_twill", include_str!("../../materials/petrak2025_cotton_twill.toml")),
];

/// Smallest and largest mass per length (kg/m) or area (kg/m²).
const MASSES: [f64; 2] = [1e-6, 1e3];
/// Largest factor of a scatter: who knows less does not know the force.
const LARGEST_FACTOR: f64 = 100.0;

/// Names of the materials that come with the program.
pub fn shipped_materials() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|(name, _)| *name)
}

/// The file of a material that comes with the program, by its name.
#[must_use]
pub fn shipped_material(name: &str) -> Option<&'static str> {
    SHIPPED.iter().find(|(shipped, _)| *shipped == name).map(|(_, text)| *text)
}

/// A shipped material by its name, or one from a file.
///
/// # Errors
/// The first fault found, with its place and a remedy; an unknown name lists the shipped ones.
pub fn read_material(name: &str) -> Result<Material, Error> {
    named(name, &(0..name.len()), &Document::new("the name of the material", name))
}

/// The material that a scene chose.
pub(super) fn material(
    choice: &Located<MaterialChoice>,
    document: &Document,
) -> Result<Material, Error> {
    match &choice.value {
        MaterialChoice::Table(table) => from_table(table, document, &choice.span, "inline"),
        MaterialChoice::Named(name) => named(name, &choice.span, document),
    }
}

fn named(name: &str, span: &Range<usize>, scene: &Document) -> Result<Material, Error> {
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
    let document = read::text(&scene.path(name), name, read::LARGEST_TOML)
        .map_err(|error| scene.error_of_named(span, error, "scene"))?;
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

fn from_file(document: &Document, name: &str) -> Result<Material, Error> {
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

/// Checks the keys of a material; `place` is the table's span, `name` replaces a missing one.
fn from_table(
    table: &MaterialTable,
    document: &Document,
    place: &Range<usize>,
    name: &str,
) -> Result<Material, Error> {
    // all models assume that a ply shears as a trellis, which only woven plies do
    if let Some(Located { value: FabricKey::Unidirectional, span }) = &table.fabric {
        return Err(document.error(
            span.clone(),
            "a unidirectional ply does not shear as a trellis: nothing holds its fibers at the points where a weft would cross them, so the ideal drape and the sheet of woven plies are not its own",
            "plydrape drapes woven plies so far, fabric = \"woven\"; for a unidirectional ply that is stitched to a weft and shears about it, that is the nearest",
        ));
    }

    // forces over the shear angle and over the strain
    let shear_curve =
        table.shear_curve.as_ref().map(|curve| curve::shear(curve, document)).transpose()?;
    let tension = table.tension.as_ref().map(|law| curve::tension(law, document)).transpose()?;

    // the source of the material also names the tests behind its values
    let text_of =
        |text: &Option<Located<String>>| text.as_ref().map(|text| line(text, document)).transpose();
    let mut source = text_of(&table.source)?.unwrap_or_else(|| "stated in the scene".into());
    let locking_angle = match (&table.locking_angle, &table.locking_test) {
        (Some(angle), Some(test)) => {
            let test = line(test, document)?;
            source = format!("{source}; locking angle: {test}");
            Some(angle.read(document)?)
        }
        (Some(angle), None) => {
            return Err(document.error(
                angle.span.clone(),
                "the locking angle does not say which test found it",
                "add locking_test = \"picture frame\" or the like",
            ));
        }
        (None, Some(test)) => {
            return Err(document.error(
                test.span.clone(),
                "the test of the locking angle says no angle",
                "add locking_angle = \"40 deg\" or the like, or leave out `locking_test`",
            ));
        }
        (None, None) => None,
    };
    if let Some(test) = text_of(&table.test)? {
        source = format!("{source}; test: {test}");
    }

    let (section, moment) = section(table, document, place)?;
    Ok(Material {
        name: text_of(&table.name)?.unwrap_or_else(|| shown::name(name)),
        source,
        section,
        moment,
        shear_curve,
        shear_rate: table
            .shear_rate
            .as_ref()
            .map(|rate| rate::shear(rate, document))
            .transpose()?,
        tension,
        locking_angle,
        scatter: scatter(table, document)?,
    })
}

/// How much the properties scatter.
fn scatter(table: &MaterialTable, document: &Document) -> Result<Scatter, Error> {
    let Some(given) = &table.scatter else { return Ok(Scatter::default()) };
    let share = |share: &Option<Quantity<Share>>| {
        share.as_ref().map(|share| scatter_share(share, "", document)).transpose()
    };
    let shear_curve = match &given.shear_curve {
        None => None,
        Some(Located { value: Curve::Slope(value), span }) => {
            let value = Located { value: value.clone(), span: span.clone() };
            let help = "; { factor = 2 } is a shear force from half to twice the value";
            Some(Spread::Share(scatter_share(&value, help, document)?))
        }
        Some(Located { value: Curve::Table(table), .. }) => {
            Some(Spread::Factor { factor: scatter_factor(&table.factor, document)? })
        }
    };
    let warp = given.bending_rigidity_warp.as_ref().or(given.flexural_rigidity.as_ref());
    Ok(Scatter {
        mass: share(&given.mass)?,
        warp_rigidity: share(&warp.cloned())?,
        weft_rigidity: share(&given.bending_rigidity_weft)?,
        tension: share(&given.tension)?,
        shear_curve,
    })
}

/// A standard deviation as a share of the value, of which it is not more; `other` ends the remedy.
fn scatter_share(share: &Quantity<Share>, other: &str, document: &Document) -> Result<f64, Error> {
    let value = share.read(document)?;
    if value <= 1.0 {
        return Ok(value);
    }
    Err(document.error(
        share.span.clone(),
        format!("{} scatters by more than the value itself", document.quoted(&share.span)),
        format!(
            "give the standard deviation as a share of the value, as in \"8 %\" or 0.08{other}"
        ),
    ))
}

/// A factor from 1 to [`LARGEST_FACTOR`].
fn scatter_factor(factor: &Quantity<Factor>, document: &Document) -> Result<f64, Error> {
    let value = factor.read(document)?;
    if (1.0..=LARGEST_FACTOR).contains(&value) {
        return Ok(value);
    }
    Err(document.error(
        factor.span.clone(),
        format!("{} is no factor of a scatter", document.quoted(&factor.span)),
        format!(
            "expected a factor from 1 to {LARGEST_FACTOR}: with 2 the force is from half to twice the value"
        ),
    ))
}

/// Mass and rigidity, both by line or both by area, and the moments that are no straight lines.
fn section(
    table: &MaterialTable,
    document: &Document,
    place: &Range<usize>,
) -> Result<(Section, [Option<MomentCurve>; 2]), Error> {
    // a mass is per length or per area by its unit, and without a unit by the rigidity beside it
    let (_, dimension) = table.mass.with_dimension(document)?;
    let by_area = table.bending_rigidity_warp.is_some() || table.bending_rigidity_weft.is_some();
    let per_length = dimension == Some(Dimension::LINE_MASS)
        || dimension.is_none() && table.flexural_rigidity.is_some();
    let usual = if per_length { &LineMass::USUAL } else { &PlyMass::USUAL };
    let mass = table.mass.within_for(document, MASSES, "a ply", &usual.within(MASSES))?;

    // mass and rigidity must be both per length or both per area
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
        (Some(rigidity), None, None) => {
            let flexural_rigidity = rigidity.read(document)?;
            Ok((Section::Line { mass, flexural_rigidity }, [None, None]))
        }
        (None, ..) if by_area && dimension == Some(Dimension::LINE_MASS) => {
            Err(mismatch("bending_rigidity_warp"))
        }
        (None, Some(warp), Some(weft)) => {
            let (warp_rigidity, warp) = bending(warp, document)?;
            let (weft_rigidity, weft) = bending(weft, document)?;
            Ok((Section::Areal { mass, warp_rigidity, weft_rigidity }, [warp, weft]))
        }
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

/// A rigidity, or the moment over the curvature and its first slope.
fn bending(
    given: &Located<Curve<Bending, MomentTable>>,
    document: &Document,
) -> Result<(f64, Option<MomentCurve>), Error> {
    match &given.value {
        Curve::Slope(rigidity) => {
            let rigidity = Located { value: rigidity.clone(), span: given.span.clone() };
            Ok((rigidity.read(document)?, None))
        }
        Curve::Table(table) => {
            let curve = curve::moment(table, document)?;
            Ok((curve.rigidity(), Some(curve)))
        }
    }
}
