//! The drape by one model as the page shows it: its measures over the steps, its grippers, and the ply in the steps that are drawn.

use super::catenaries::{Catenaries, Detail};
use super::course::{MeasureCourse, courses};
use super::field::Field;
use super::grippers::Grippers;
use super::sheet::{KeptStates, Sheet};
use super::{Form, block::Block, cell};
use crate::Error;
use crate::result::ResultFile;
use plydrape::layup::Model;
use plydrape::outcome::{Step, Summary};
use serde::Serialize;

/// The drape by one model over the steps of the page.
#[derive(Serialize)]
pub(super) struct PageDrape<'a> {
    model: Model,
    /// Steps in which the ply is drawn.
    pub drawn: Vec<usize>,
    /// For each step of the page that the model has done, which of the drawn ones is the nearest.
    pictures: Vec<usize>,
    pub measures: Vec<MeasureCourse<'a>>,
    pub fields: Vec<Field>,
    grippers: Grippers,
    /// Where bodies are that move with grippers and robot.
    origins: Option<Block>,
    catenaries: Option<Catenaries>,
    sheet: Option<Sheet>,
}

/// A drape that is to be shown.
pub(super) struct Source<'a> {
    pub result: &'a ResultFile,
    pub summary: &'a Summary,
    pub steps: &'a [Step],
    /// Whether its model decides.
    pub decides: bool,
}

impl<'a> Source<'a> {
    /// The drape by the model that decides.
    pub fn deciding(result: &'a ResultFile) -> Self {
        Source { result, summary: &result.summary, steps: &result.steps, decides: true }
    }

    /// The drape by the other model, if there is one.
    pub fn beside(result: &'a ResultFile) -> Option<Self> {
        let also = result.also.as_ref()?;
        Some(Source { result, summary: &also.summary, steps: &also.steps, decides: false })
    }

    /// Drape over the steps of the page; `kept` are the states of the sheet, if its model is that.
    ///
    /// # Errors
    /// [`Error`] if the states of the sheet cannot be read.
    pub fn show(
        &self,
        numbers: &[usize],
        detail: &Detail,
        kept: Option<KeptStates>,
        form: Form,
    ) -> Result<PageDrape<'a>, Error> {
        let Source { result, summary, steps: all, decides } = *self;
        let judged = if decides { summary.limits.as_slice() } else { &[] };
        let steps = done(all, numbers);

        // the ply in the steps that are drawn
        let (drawn, fields, catenaries, sheet, released) = match (summary.model, kept) {
            (Model::Catenaries, _) => {
                let drawn: Vec<&Step> = detail.steps.iter().filter_map(|k| all.get(*k)).collect();
                let (catenaries, fields) = Catenaries::new(result, &drawn, detail, judged, form);
                let drawn = drawn.iter().map(|step| step.step).collect();
                (drawn, fields, Some(catenaries), None, Vec::new())
            }
            (Model::Sheet, Some(kept)) => {
                let drawn = kept.steps();
                let (sheet, fields, released) = Sheet::new(self, kept)?;
                let at_end = drawn.last() == steps.last().map(|step| &step.step);
                (drawn, fields, None, Some(sheet), if at_end { released } else { Vec::new() })
            }
            (Model::Sheet, None) => (Vec::new(), Vec::new(), None, None, Vec::new()),
        };

        let pictures = steps.iter().filter_map(|step| nearest(&drawn, step.step)).collect();
        Ok(PageDrape {
            model: summary.model,
            pictures,
            drawn,
            measures: courses(&steps, numbers.len(), judged),
            fields,
            grippers: Grippers::new(&steps, &released, decides.then_some(judged), form),
            origins: cell::origins(result, &steps, form),
            catenaries,
            sheet,
        })
    }
}

/// The steps with some numbers, up to the first one that was not done.
fn done<'a>(steps: &'a [Step], numbers: &[usize]) -> Vec<&'a Step> {
    let find = |number: &usize| steps.binary_search_by_key(number, |step| step.step).ok();
    numbers.iter().map_while(find).map(|k| &steps[k]).collect()
}

/// Index of the step nearest to another, of two the earlier one.
fn nearest(steps: &[usize], step: usize) -> Option<usize> {
    (0..steps.len()).min_by_key(|k| steps[*k].abs_diff(step))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// A step without a picture has that of the nearest step with one, of two the earlier.
    #[test]
    fn the_nearest_picture_is_shown() {
        let drawn = [1, 5, 12];
        let shown = [1, 2, 3, 4, 8, 9, 12].map(|step| drawn[nearest(&drawn, step).unwrap()]);
        assert_eq!(shown, [1, 1, 1, 5, 5, 12, 12]);
        assert_eq!(nearest(&[], 3), None);
    }

    /// A drape that ended early has the first steps of the page, and no others.
    #[test]
    fn a_drape_has_the_steps_that_it_has_done() {
        let result = sample::draped(2, 2, 4);
        let numbers = |steps: &[usize]| -> Vec<usize> {
            done(&result.steps, steps).iter().map(|step| step.step).collect()
        };
        assert_eq!(numbers(&[1, 3, 4]), [1, 3, 4]);
        assert_eq!(numbers(&[2, 3, 5, 4]), [2, 3]);
    }
}
