//! A result for VTK's readers, such as ParaView: XML PolyData and collections of it over time.
//!
//! | files | what |
//! |---|---|
//! | `ply.pvd`, `ply_0001.vtp` … | the surface between the catenaries in quads (`ply`); none for a strip, nor where no catenaries were draped |
//! | `catenaries.pvd`, `catenaries_0001.vtp` … | every catenary in its pieces (`catenaries`); none where none were draped |
//! | `grippers.pvd`, `grippers_0001.vtp` … | a point for each gripper (`grippers`), by the model that decides |
//! | `sheet.pvd`, `sheet_0001.vtp` … | the cells of the sheet in each step that was kept (`sheet`); none without a sheet |
//! | `pads.pvd`, `pads_0001.vtp` … | the pads of the sheet and the forces on them |
//! | `mold.vtp` | the mold under the drape (`mold`), if there is one |
//! | `drape.pvd` | all of them as parts of one series |
//!
//! A number in a file's name is that of its step. Points are in meters, z up; arrays say their unit in their
//! names (`slack_mm`). No array holds NaN: what is not known is 0, and an array beside it says so
//! (`has_force`). `polydata` and `collection` write the formats.

mod catenaries;
mod collection;
mod grippers;
mod mold;
mod ply;
pub(crate) mod polydata;
mod sheet;

use crate::Error;
use crate::result::ResultFile;
use crate::result::sheet::SheetSides;
use collection::{Collection, Part};
use plydrape::layup::Model;

/// All files: names and contents. Same result, same bytes.
///
/// # Errors
/// [`Error`] if a number is not finite, or the states of the sheet cannot be read.
pub fn files(result: &ResultFile) -> Result<Vec<(String, Vec<u8>)>, Error> {
    result.check_finite()?;
    let mut files = Vec::new();
    let mut all = Collection::default();
    let surface = result.scene.ply.lines().surface().cells() > 0;
    let mut series = ["ply", "catenaries", "grippers"].map(|name| (name, Collection::default()));
    // a drape of 10 000 steps is still in order in a folder
    let digits = result.steps.last().map_or(1, |step| step.step).to_string().len().max(4);
    let mold = mold::mold(result);

    // the catenaries that decide, or those that were asked for beside
    let lines = result.steps_of(Model::Catenaries).unwrap_or_default();
    for step in &result.steps {
        let hanging = lines.get(step.step.saturating_sub(1));
        for (part, (name, collection)) in series.iter_mut().enumerate() {
            let data = match (*name, hanging) {
                ("grippers", _) => grippers::grippers(step),
                ("ply", Some(hanging)) if surface => ply::ply(result, hanging),
                ("catenaries", Some(hanging)) => catenaries::catenaries(result, hanging),
                _ => continue,
            };
            let file = format!("{name}_{:0digits$}.vtp", step.step);
            let own = Part { time: step.time, part, name, file: file.clone() };
            collection.parts.push(Part { part: 0, ..own.clone() });
            all.parts.push(own);
            files.push((file, data.with_time(step.time).bytes()));
        }
        if mold.is_some() {
            let (part, name) = (series.len(), "mold");
            all.parts.push(Part { time: step.time, part, name, file: "mold.vtp".into() });
        }
    }
    files.extend(mold.map(|data| ("mold.vtp".to_owned(), data.bytes())));

    // the sheet in the steps that were kept
    let mut of_sheet = ["sheet", "pads"].map(|name| (name, Collection::default()));
    if let Some(kept) = &result.sheet_states {
        let mut states = kept.open()?;
        let sides = SheetSides::new(states.mesh());
        for (step, n) in states.steps()? {
            let Some(state) = states.state(n)? else { continue };
            let data = [
                sheet::sheet(states.mesh(), states.landing_step(), &sides, &state),
                sheet::pads(&state),
            ];
            for (k, (data, (name, collection))) in data.into_iter().zip(&mut of_sheet).enumerate() {
                let file = format!("{name}_{step:0digits$}.vtp");
                let (time, part) = (state.time, series.len() + 1 + k);
                let own = Part { time, part, name, file: file.clone() };
                collection.parts.push(Part { part: 0, ..own.clone() });
                all.parts.push(own);
                files.push((file, data.with_time(time).bytes()));
            }
        }
    }
    for (name, collection) in series.into_iter().chain(of_sheet).chain([("drape", all)]) {
        if !collection.parts.is_empty() {
            files.push((format!("{name}.pvd"), collection.text().into_bytes()));
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// Three files a step, the mold and four collections; the same bytes again from the same result.
    #[test]
    fn the_same_result_gives_the_same_bytes() {
        let result = sample::draped(3, 2, 4);
        let first = files(&result).unwrap();
        let names: Vec<&str> = first.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names.len(), 3 * 4 + 1 + 4);
        assert_eq!(names[..3], ["ply_0001.vtp", "catenaries_0001.vtp", "grippers_0001.vtp"]);
        let rest = ["mold.vtp", "ply.pvd", "catenaries.pvd", "grippers.pvd", "drape.pvd"];
        assert_eq!(names[12..], rest);
        assert!(first == files(&result).unwrap());
    }

    /// A strip has no surface, so no file claims one.
    #[test]
    fn a_strip_has_no_surface() {
        let names: Vec<String> =
            files(&sample::hanging(3, 1)).unwrap().into_iter().map(|(name, _)| name).collect();
        assert!(names.iter().all(|name| !name.starts_with("ply")), "{names:?}");
        assert!(names.iter().any(|name| name == "drape.pvd"));
    }

    /// A number that is not finite would be read as something else.
    #[test]
    fn a_number_that_is_not_finite_is_refused() {
        let mut result = sample::draped(3, 2, 2);
        result.steps[1].grippers[0].position[2] = f64::NAN;
        assert!(files(&result).is_err());
    }
}
