//! What the shear force of a material does, as text: the motion of the scene, draped with it and with a multiple of it.

use super::SummaryLine;
use super::limits::packed;
use crate::argument::refused;
use crate::failure::Failure;
use crate::numbers::{degrees, rounded, short};
use plydrape::measure::Verdict;
use plydrape::outcome::{Judged, judge};
use plydrape_io::scene::SceneFile;

/// Factors that are taken: beyond them no ply is.
const FACTORS: std::ops::RangeInclusive<f64> = 1e-3..=1e3;
/// Least change that is named, as a share of the limit.
const CHANGE: f64 = 0.01;

/// The factor of an option, which multiplies the shear force.
pub(super) fn factor(text: &str) -> Result<f64, Failure> {
    let range = "a positive number, from 0.001 to 1000";
    match text.trim().parse::<f64>() {
        Ok(factor) if FACTORS.contains(&factor) => Ok(factor),
        _ => {
            let help = "give how many times the shear force of the material it shall be, as in --shear-scale 3";
            Err(refused("--shear-scale", text, &format!("is not {range}"), help))
        }
    }
}

/// The shear force where the ideal drape is sheared most, and each measure that the factor changes.
pub(super) fn shear(scene: &SceneFile, factor: f64) -> Result<Vec<SummaryLine>, Failure> {
    // without a shear force there is nothing to multiply
    let layup = &scene.layup;
    let Some(curve) = &layup.ply.material.shear_curve else {
        return Err(Failure::Refused {
            message: format!(
                "--shear-scale needs a shear force, and the material {} has none",
                layup.ply.material.name
            ),
            help: "give `shear_curve` in [ply.material], or name a material that has one, such as prepreg_warm".into(),
        });
    };

    // both forces at the largest shear angle of the ideal drape
    let drape = layup.target.as_ref().and_then(|target| target.drape.as_ref());
    let angle = drape.and_then(|net| net.report.largest_shear).map(|(angle, _)| angle.abs());
    let force = angle.map(|angle| {
        let own = curve.force(angle).0;
        let [own, scaled] = [own, factor * own].map(digits);
        let angle = degrees(angle);
        format!("{scaled} N/m where the ideal drape is sheared by {angle} deg, in place of {own}")
    });
    let head = format!("{} times that of the material", short(factor));
    let force = force.map_or(head.clone(), |force| format!("{head}: {force}"));

    // the motion of the scene, draped with both
    let mut scaled = layup.clone();
    scaled.ply.material = layup.ply.material.with_shear(factor);
    let [own, scaled] = [layup, &scaled]
        .map(|layup| judge(layup, &scene.limits, usize::MAX, &|| false))
        .map(|judged| judged.map_err(plydrape_io::Error::from));
    let lines = changes(&own?, &scaled?);
    Ok(std::iter::once(("shear", force)).chain(lines.into_iter().map(|line| ("", line))).collect())
}

/// The measures of two drapes of one motion that differ.
fn changes(own: &Judged, scaled: &Judged) -> Vec<String> {
    let differs = |[own, scaled]: [&Verdict; 2]| {
        let change = (scaled.value - own.value).abs();
        own.judged && scaled.judged && change > CHANGE * scaled.limit.abs()
    };
    let text = |[own, scaled]: [&Verdict; 2]| {
        let unit = match &*own.unit {
            "1" => String::new(),
            unit => format!(" {unit}"),
        };
        let fault = if scaled.ok { "" } else { " FAIL" };
        let (title, value) = (own.name.title(), digits(scaled.value));
        format!("{title} {value}{unit}{fault} in place of {}", digits(own.value))
    };
    let pairs = own.limits.iter().filter_map(|verdict| {
        Some([verdict, scaled.limits.iter().find(|other| other.name == verdict.name)?])
    });
    let mut texts: Vec<String> = pairs.filter(|pair| differs(*pair)).map(text).collect();
    if own.complete != scaled.complete {
        let which = if scaled.complete { "with that of the material" } else { "with it" };
        texts.push(format!("not draped to the end {which}"));
    }
    if texts.is_empty() {
        texts.push("nothing changes by a hundredth of its limit".into());
    }
    packed("the motion of the scene, draped with both: ", &texts)
}

/// Three digits.
fn digits(value: f64) -> String {
    short(rounded(value))
}
