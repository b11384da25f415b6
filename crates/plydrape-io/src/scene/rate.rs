//! What resin adds to the shear force of a material, and the temperature of a ply.

use super::choice::Curve;
use super::file::{RelaxationTable, ShearRateTable};
use super::located::Located;
use super::quantity::{Quantity, Read};
use super::source::Document;
use super::units::FREEZING;
use super::usual::PlyTemperature;
use crate::Error;
use plydrape::material::{Material, Relaxation, ShearRate};

/// Temperature of a relaxation that is known at one alone (K): no number depends on it.
const ROOM: f64 = FREEZING + 20.0;

/// The keys of `shear_rate`, at the lowest temperature that it knows.
pub(super) fn shear(
    table: &Located<ShearRateTable>,
    document: &Document,
) -> Result<ShearRate, Error> {
    let ShearRateTable { stiffness, relaxation } = &table.value;
    let stiffness = stiffness.read(document)?;
    let relaxation = match &relaxation.value {
        Curve::Slope(time) => {
            let time = Located { value: time.clone(), span: relaxation.span.clone() };
            let time = time.read(document)?;
            Relaxation { temperature: vec![ROOM], time: vec![time] }
        }
        Curve::Table(table) => over_temperatures(table, document)?,
    };
    Ok(ShearRate { stiffness, temperature: relaxation.temperature[0], relaxation })
}

/// Relaxation times that fall as temperatures rise.
fn over_temperatures(table: &RelaxationTable, document: &Document) -> Result<Relaxation, Error> {
    // a time for each temperature, two or more
    let RelaxationTable { temperature, time } = table;
    let counts = [temperature.value.len(), time.value.len()];
    if counts[0] != counts[1] || counts[0] < 2 {
        return Err(document.error(
            time.span.clone(),
            format!("the relaxation has {} temperatures and {} times", counts[0], counts[1]),
            "give as many times as temperatures, two or more, or one time alone, as in relaxation = \"0.4 s\"",
        ));
    }

    // a warmer resin relaxes faster: temperatures rise and times fall
    let mut known = Relaxation { temperature: Vec::new(), time: Vec::new() };
    for (temperature, time) in temperature.value.iter().zip(&time.value) {
        let kelvin = temperature.read(document)?;
        let seconds = time.read(document)?;
        let (at, fault) = match (known.temperature.last(), known.time.last()) {
            (Some(last), _) if kelvin <= *last => {
                (&temperature.span, "the temperatures of the relaxation do not rise")
            }
            (_, Some(last)) if seconds >= *last => {
                (&time.span, "the relaxation takes no less time where it is warmer")
            }
            _ => {
                known.temperature.push(kelvin);
                known.time.push(seconds);
                continue;
            }
        };
        let help = "give rising temperatures and falling times, as in { temperature = [\"25 degC\", \"60 degC\"], time = [\"2 s\", \"80 ms\"] }";
        return Err(document.error(at.clone(), fault, help));
    }
    Ok(known)
}

/// Gives the ply of a material its temperature.
pub(super) fn set_temperature(
    material: &mut Material,
    temperature: &Quantity<PlyTemperature>,
    document: &Document,
) -> Result<(), Error> {
    // a temperature matters only where relaxation times are known at several temperatures
    let kelvin = temperature.read(document)?;
    let rate = material.shear_rate.as_mut().filter(|rate| rate.relaxation.temperature.len() > 1);
    let Some(rate) = rate else {
        return Err(document.error(
            temperature.span.clone(),
            format!("the material {} does not say what a temperature changes", material.name),
            "leave it out, or give the material the relaxation times of its resin, as in shear_rate = { stiffness = \"200 N/m\", relaxation = { temperature = [\"25 degC\", \"60 degC\"], time = [\"2 s\", \"80 ms\"] } }",
        ));
    };

    // relaxation times are known between the coldest and the warmest of these
    let known = &rate.relaxation.temperature;
    let [coldest, warmest] = [known[0], known[known.len() - 1]];
    if !(coldest..=warmest).contains(&kelvin) {
        let [coldest, warmest] = [coldest, warmest].map(|kelvin| (kelvin - FREEZING).round());
        return Err(document.error(
            temperature.span.clone(),
            format!(
                "the relaxation of {} is not known at {}",
                material.name,
                document.quoted(&temperature.span)
            ),
            format!(
                "it is known from {coldest} degC to {warmest} degC: give a temperature between them"
            ),
        ));
    }
    rate.temperature = kelvin;
    Ok(())
}
